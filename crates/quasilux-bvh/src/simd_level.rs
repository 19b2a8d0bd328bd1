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

impl SimdLevel {
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
