//! Pointers from C become slices, texts and places to write, or a refusal.

use super::refusal::Refusal;
use std::ffi::CStr;

/// `count` items at `pointer`; NULL is legal where there are none.
///
/// # Safety
/// A pointer that is not NULL points to `count` readable items that live and stay unchanged while
/// the slice is used.
pub unsafe fn slice<'a, T>(
    argument: &'static str,
    pointer: *const T,
    count: usize,
) -> Result<&'a [T], Refusal> {
    if count == 0 {
        return Ok(&[]);
    }
    check(argument, pointer, count)?;
    // SAFETY: not NULL, aligned and short enough by `check`; readable by this function's contract.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Places of the host's memory to write to. They may be uninitialised, so that no reference to them
/// is ever made; they are written after all that can be refused.
#[derive(Debug)]
pub struct Destination<T> {
    pointer: *mut T,
    count: usize,
}

impl<T: Copy> Destination<T> {
    /// `count` places at `pointer`; NULL is legal where there are none.
    ///
    /// # Safety
    /// A pointer that is not NULL points to `count` places that may be written until
    /// [`Destination::write`] returns, and that nobody else uses meanwhile.
    pub unsafe fn new(
        argument: &'static str,
        pointer: *mut T,
        count: usize,
    ) -> Result<Destination<T>, Refusal> {
        if count > 0 {
            check(argument, pointer, count)?;
        }
        Ok(Destination { pointer, count })
    }

    /// Writes one value; a place beyond the last is none.
    pub fn write_at(&self, place: usize, value: T) {
        if place < self.count {
            // SAFETY: `new` was promised `count` writable places, and this is one of them.
            unsafe { self.pointer.add(place).write(value) }
        }
    }

    /// Writes the values; no more of them than there are places.
    pub fn write(self, values: &[T]) {
        let count = values.len().min(self.count);
        if count > 0 {
            // SAFETY: `new` was promised `count` writable places that do not overlap Rust's.
            unsafe { std::ptr::copy_nonoverlapping(values.as_ptr(), self.pointer, count) }
        }
    }
}

/// A text of the host.
///
/// # Safety
/// A pointer that is not NULL points to characters that end with NUL and stay unchanged while the
/// text is used.
pub unsafe fn text<'a>(
    argument: &'static str,
    pointer: *const libc::c_char,
) -> Result<&'a str, Refusal> {
    check(argument, pointer, 1)?;
    // SAFETY: not NULL by `check`; NUL-terminated by this function's contract.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|_| Refusal::NotUtf8 { argument })
}

fn check<T>(argument: &'static str, pointer: *const T, count: usize) -> Result<(), Refusal> {
    if pointer.is_null() {
        return Err(Refusal::NullPointer { argument });
    }
    if !pointer.is_aligned() {
        return Err(Refusal::Misaligned { argument });
    }
    let largest = isize::MAX as usize / size_of::<T>().max(1);
    if count > largest {
        return Err(Refusal::TooMany {
            argument,
            count,
            largest,
        });
    }
    Ok(())
}
