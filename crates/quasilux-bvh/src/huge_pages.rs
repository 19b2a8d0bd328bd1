//! Allocations in huge pages (2 MiB), where the system has them.
//!
//! A ray touches memory all over a hierarchy. With pages of 4 KiB most of these accesses miss the
//! translation lookaside buffer as well as the caches.

/// An empty vector with room for `capacity` elements, in huge pages where the system has them.
pub(crate) fn vec_in_huge_pages<T>(capacity: usize) -> Vec<T> {
    let list = Vec::with_capacity(capacity);
    #[cfg(target_os = "linux")]
    linux::advise(list.as_ptr() as usize, capacity * size_of::<T>());
    list
}

#[cfg(target_os = "linux")]
mod linux {
    use std::ffi::c_void;

    const HUGE_PAGE_BYTES: usize = 1 << 21;

    /// Asks for huge pages for the part of an allocation that whole ones fit into.
    pub(super) fn advise(start: usize, length: usize) {
        let first = start.next_multiple_of(HUGE_PAGE_BYTES);
        let end = (start + length) / HUGE_PAGE_BYTES * HUGE_PAGE_BYTES;
        if first < end {
            // SAFETY: the pages belong to an allocation of this crate, and the advice leaves their
            // contents as they are. Where it fails, pages stay small.
            unsafe { libc::madvise(first as *mut c_void, end - first, libc::MADV_HUGEPAGE) };
        }
    }
}
