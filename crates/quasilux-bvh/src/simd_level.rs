//! The instruction sets of the traversal, and the one place that dispatches to them.

use crate::lanes::{Lanes, Portable};
use std::sync::OnceLock;

/// Which instructions are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SimdLevel {
    /// Instructions of every machine.
    Portable,
    /// AVX2 and fused multiply-add of x86-64.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// The masks of AVX-512 (F, VL, DQ), eight numbers wide.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// The one that was chosen for this process.
static CHOSEN: OnceLock<SimdLevel> = OnceLock::new();

impl SimdLevel {
    /// The one that was chosen for this process, or else the fastest.
    #[must_use]
    pub fn chosen() -> Self {
        CHOSEN.get().copied().unwrap_or_else(Self::fastest)
    }

    /// Chooses one for this process, once for all, for tests: no result depends on it.
    pub fn choose(self) {
        CHOSEN.get_or_init(|| self);
    }

    /// The one with a name, if this machine can run it.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|level| level.name() == name)
    }

    /// Name of the level: `portable`, `avx2` or `avx512`.
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
            assert_eq!(SimdLevel::named(level.name()), Some(level));
        }
        assert_eq!(SimdLevel::named("sse9"), None);
    }
}
