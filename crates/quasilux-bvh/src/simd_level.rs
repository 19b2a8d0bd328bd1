//! The instruction sets of the traversal, and the one place that dispatches to them.

use crate::lanes::{Lanes, Portable};

/// Which instructions are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SimdLevel {
    /// Those of every machine.
    Portable,
    /// AVX2 and fused multiply-add of x86-64.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// The masks of AVX-512 (F, VL, DQ), eight numbers wide.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// Asks for one of [`SimdLevel::all`] by its name, for tests: no result depends on it.
const VARIABLE: &str = "QUASILUX_KERNEL";

impl SimdLevel {
    /// That which the environment variable `QUASILUX_KERNEL` names, or where it is not set or
    /// empty the fastest.
    ///
    /// # Errors
    /// In words, where it names none that this machine can run.
    pub fn chosen() -> Result<Self, String> {
        match std::env::var_os(VARIABLE) {
            Some(name) if !name.is_empty() => Self::named(&name.to_string_lossy()),
            _ => Ok(Self::fastest()),
        }
    }

    fn named(name: &str) -> Result<Self, String> {
        let all = Self::all();
        all.iter().copied().find(|level| level.name() == name).ok_or_else(|| {
            let names: Vec<&str> = all.into_iter().map(Self::name).collect();
            format!("{VARIABLE} is {name:?}; expected one of {}, or nothing", names.join(", "))
        })
    }

    /// What it is called: `portable`, `avx2` or `avx512`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Self::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Self::Avx512 => "avx512",
        }
    }

    /// The fastest one on this machine: [`Self::Avx512`] was as fast as [`Self::Avx2`] on an AMD
    /// EPYC that has both (0.95 to 1.08 times, `docs/speed.md`).
    #[must_use]
    pub fn fastest() -> Self {
        #[cfg(target_arch = "x86_64")]
        if crate::lanes::Avx2::is_supported() {
            return Self::Avx2;
        }
        Self::Portable
    }

    /// All that this machine can run.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self::Portable];
        #[cfg(target_arch = "x86_64")]
        {
            all.extend(crate::lanes::Avx2::is_supported().then_some(Self::Avx2));
            all.extend(crate::lanes::Avx512::is_supported().then_some(Self::Avx512));
        }
        all
    }

    /// Runs an task with these instructions.
    #[inline(always)]
    pub(crate) fn run<E: SimdTask>(self, task: E) -> E::Result {
        match self {
            Self::Portable => task.run::<Portable>(),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: this kernel is only chosen where the features are there.
            Self::Avx2 => unsafe { run_avx2(task) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: this kernel is only chosen where the features are there.
            Self::Avx512 => unsafe { run_avx512(task) },
        }
    }
}

/// Work that can be done with any instructions. `run` must be inlined into where they are enabled.
pub(crate) trait SimdTask {
    type Result;

    fn run<L: Lanes>(self) -> Self::Result;
}

/// # Safety
/// The machine must have what [`crate::lanes::Avx2::is_supported`] asks for.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
unsafe fn run_avx2<E: SimdTask>(task: E) -> E::Result {
    task.run::<crate::lanes::Avx2>()
}

/// # Safety
/// The machine must have what [`crate::lanes::Avx512::is_supported`] asks for.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
unsafe fn run_avx512<E: SimdTask>(task: E) -> E::Result {
    task.run::<crate::lanes::Avx512>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_is_found_by_its_name_and_no_other() {
        for level in SimdLevel::all() {
            assert_eq!(SimdLevel::named(level.name()), Ok(level));
        }
        let refusal = SimdLevel::named("sse9").unwrap_err();
        assert!(refusal.contains("\"sse9\"; expected one of portable"), "{refusal}");
    }
}
