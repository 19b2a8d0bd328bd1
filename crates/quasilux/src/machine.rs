//! What the machine has left for the program: memory.

use std::path::Path;

/// Where nobody tells how much memory there is.
const UNKNOWN_BYTES: u64 = 16 << 30;
/// Least that a bound leaves: small runs are never refused for what others take at the moment.
const MIN_BYTES: u64 = 256 << 20;

/// Memory in bytes that the program can take before the machine has none: the least of what the
/// system has available, what control groups leave, and what a limit of the process allows; 16 GiB
/// where none of these can be read.
pub(crate) fn available_bytes() -> u64 {
    let told = [of_system(), of_groups(), of_process()].into_iter().flatten().min();
    told.unwrap_or(UNKNOWN_BYTES).max(MIN_BYTES)
}

/// As the kernel of Linux estimates it: free, or given back when it is asked for.
fn of_system() -> Option<u64> {
    in_kib(&std::fs::read_to_string("/proc/meminfo").ok()?, "MemAvailable:")
}

/// The tightest of the group of the process and those above it (Linux, versions 2 and 1).
fn of_groups() -> Option<u64> {
    let groups = std::fs::read_to_string("/proc/self/cgroup").ok()?;
    groups.lines().filter_map(of_group_and_above).min()
}

/// Of one line, like `0::/user.slice` or `4:memory:/user.slice`.
fn of_group_and_above(line: &str) -> Option<u64> {
    let mut parts = line.splitn(3, ':');
    let (_, controllers, group) = (parts.next()?, parts.next()?, parts.next()?);
    let (root, limit, usage) = if controllers.is_empty() {
        ("/sys/fs/cgroup", "memory.max", "memory.current")
    } else if controllers.split(',').any(|name| name == "memory") {
        ("/sys/fs/cgroup/memory", "memory.limit_in_bytes", "memory.usage_in_bytes")
    } else {
        return None;
    };
    let left = |folder: &Path| -> Option<u64> {
        let number = |name: &str| -> Option<u64> {
            std::fs::read_to_string(folder.join(name)).ok()?.trim().parse().ok()
        };
        Some(number(limit)?.saturating_sub(number(usage)?))
    };
    let own = Path::new(root).join(group.trim_start_matches('/'));
    own.ancestors().take_while(|folder| folder.starts_with(root)).filter_map(left).min()
}

/// What `ulimit -v` leaves (Linux).
fn of_process() -> Option<u64> {
    let limits = std::fs::read_to_string("/proc/self/limits").ok()?;
    let line = limits.lines().find_map(|line| line.strip_prefix("Max address space"))?;
    let limit: u64 = line.split_whitespace().next()?.parse().ok()?;
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    Some(limit.saturating_sub(in_kib(&status, "VmSize:")?))
}

/// The number of a line like `MemAvailable:  1234 kB`.
fn in_kib(text: &str, label: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(label))?;
    let kib: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib.saturating_mul(1024))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_the_kernel_are_read() {
        let text = "MemTotal:       24 kB\nMemAvailable:   1024 kB\n";
        assert_eq!(in_kib(text, "MemAvailable:"), Some(1 << 20));
        assert_eq!(in_kib(text, "MemFree:"), None);
        assert_eq!(in_kib("VmSize: unlimited", "VmSize:"), None);
        assert_eq!(of_group_and_above("1:cpu:/"), None);
        assert_eq!(of_group_and_above("no group"), None);
    }

    #[test]
    fn a_machine_has_memory() {
        assert!(available_bytes() >= MIN_BYTES);
    }
}
