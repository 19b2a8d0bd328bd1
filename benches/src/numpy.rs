//! numpy's PCG64 in a process of its own, which waits for its turn.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

const SCRIPT: &str = "
import sys, time, numpy
count, block = int(sys.argv[1]), numpy.empty(int(sys.argv[2]))
generator = numpy.random.Generator(numpy.random.PCG64(1))
print('ready', flush=True)
for _ in sys.stdin:
    start = time.perf_counter()
    for _ in range(count // len(block)):
        generator.random(out=block)
    print(time.perf_counter() - start, flush=True)
";

/// The waiting process.
pub(crate) struct Numpy {
    process: Child,
    turns: ChildStdin,
    answers: BufReader<ChildStdout>,
}

impl Numpy {
    /// Starts it; `count` coordinates a turn, in blocks of `block`. `None` where it is not
    /// installed.
    pub(crate) fn start(count: usize, block: usize) -> Option<Self> {
        let mut process = Command::new("python3")
            .args(["-c", SCRIPT, &count.to_string(), &block.to_string()])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .ok()?;
        let turns = process.stdin.take()?;
        let answers = BufReader::new(process.stdout.take()?);
        let mut numpy = Self { process, turns, answers };
        (numpy.line()? == "ready").then_some(numpy)
    }

    /// Takes a turn: how long it took in s.
    pub(crate) fn seconds(&mut self) -> f64 {
        let asked = writeln!(self.turns).and_then(|()| self.turns.flush()).ok();
        let answer = asked.and_then(|()| self.line()).and_then(|line| line.parse().ok());
        answer.unwrap_or(f64::NAN)
    }

    fn line(&mut self) -> Option<String> {
        let mut line = String::new();
        self.answers.read_line(&mut line).ok()?;
        Some(line.trim().to_owned())
    }
}

impl Drop for Numpy {
    fn drop(&mut self) {
        // Nothing is left to be saved.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}
