//! Lists in large pages.
//!
//! A ray touches memory all over a hierarchy; with pages of 4 KiB most of these touches miss the
//! processor's table of pages as well as its caches.

/// An empty list with room for so many elements, in large pages where the system has them.
pub(crate) fn vec_in_huge_pages<T>(capacity: usize) -> Vec<T> {
    let list = Vec::with_capacity(capacity);
    #[cfg(target_os = "linux")]
    linux::advise(list.as_ptr() as usize, capacity * size_of::<T>());
    list
}

#[cfg(target_os = "linux")]
mod linux {
    use std::ffi::{c_int, c_void};

    const LARGE_PAGE: usize = 1 << 21;
    const MADV_HUGEPAGE: c_int = 14;

    unsafe extern "C" {
        fn madvise(start: *mut c_void, length: usize, advice: c_int) -> c_int;
    }

    /// Asks for large pages for all of them that lie inside.
    pub(super) fn advise(start: usize, length: usize) {
        let first = start.next_multiple_of(LARGE_PAGE);
        let end = (start + length) / LARGE_PAGE * LARGE_PAGE;
        if first < end {
            // SAFETY: the pages belong to an allocation of ours, and this advice leaves what is in
            // them as it is. Where it fails, pages stay small.
            unsafe { madvise(first as *mut c_void, end - first, MADV_HUGEPAGE) };
        }
    }
}
