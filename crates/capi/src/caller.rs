//! The caller's memory. Its pointers come in as these types, which C alone can make (their fields are private), and
//! everything that is read or written through them is here.
//!
//! What the header asks of the caller is what every SAFETY comment here leans on: a pointer is null, or it points to
//! memory of the size that the struct or the length argument says, which nobody else writes during the call. It
//! need not be aligned.

use crate::code::{Code, Outcome};
use std::ffi::{CStr, CString, c_char, c_void};

/// Largest struct that is believed; what is larger was never initialised.
const LARGEST: usize = 4096;

/// A struct of the header that says its own size.
///
/// # Safety
/// `repr(C)`, without padding, any bits are a value, and a `u32` with the struct's size is at byte `SIZE_AT`.
pub unsafe trait Record: Copy {
    /// Where its size is.
    const SIZE_AT: usize;
    /// Its size when it was first published.
    const FIRST_SIZE: usize;
}

/// What never grows.
///
/// # Safety
/// Any bits are a value.
pub unsafe trait Plain: Copy {}

// SAFETY: as the trait asks.
unsafe impl<const N: usize> Plain for [f64; N] {}

// SAFETY: as the trait asks.
unsafe impl Plain for f64 {}

/// A struct that stands in arrays of the caller's, who says its size with them.
pub trait Element: Copy {
    /// Its size when it was first published.
    const FIRST_SIZE: usize;
}

/// A struct that is read.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct In<T>(*const T);

/// Where a result is written.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct Out<T>(*mut T);

/// A text, up to its NUL.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct Text(*const c_char);

/// A buffer for `capacity` elements, which comes as the next argument.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct Buffer<T>(*mut T);

/// The size that the struct at `place` says.
fn said_size<T: Record>(place: *const u8) -> Result<usize, Code> {
    if place.is_null() {
        return Err(Code::ERROR_NULL);
    }
    // SAFETY: not null, and every version of the struct has its size there.
    let size = unsafe { place.add(T::SIZE_AT).cast::<u32>().read_unaligned() } as usize;
    if (T::FIRST_SIZE..=LARGEST).contains(&size) { Ok(size) } else { Err(Code::ERROR_STRUCT) }
}

impl<T: Record> In<T> {
    /// Reads it over `defaults`: a tail that the caller does not know keeps them. A tail that this library does
    /// not know must be zero, else something would be asked for that is not done.
    pub fn read(self, defaults: T) -> Result<T, Code> {
        let from = self.0.cast::<u8>();
        let size = said_size::<T>(from)?;
        let mut value = defaults;
        let known = size.min(size_of::<T>());
        // SAFETY: both are at least `known` bytes, they do not overlap, and any bits are a `T`.
        unsafe { from.copy_to_nonoverlapping((&raw mut value).cast(), known) };
        // SAFETY: the struct is `size` bytes.
        let unknown = (known..size).any(|at| unsafe { from.add(at).read() } != 0);
        if unknown { Err(Code::ERROR_UNSUPPORTED) } else { Ok(value) }
    }
}

impl<T: Plain> In<T> {
    /// None.
    pub const NULL: Self = Self(std::ptr::null());

    /// Reads it if it is given: where null is no mistake.
    pub fn if_given(self) -> Option<T> {
        self.whole().ok()
    }

    /// Reads it whole: what never grows.
    pub fn whole(self) -> Result<T, Code> {
        if self.0.is_null() {
            return Err(Code::ERROR_NULL);
        }
        // SAFETY: not null, hence a `T`.
        Ok(unsafe { self.0.read_unaligned() })
    }

    /// Reads the `count` of them that are there.
    pub fn several(self, count: usize) -> Result<Vec<T>, Code> {
        if self.0.is_null() {
            return Err(Code::ERROR_NULL);
        }
        // SAFETY: not null, hence `count` of `T`.
        Ok((0..count).map(|at| unsafe { self.0.add(at).read_unaligned() }).collect())
    }
}

impl<T: Copy> Out<T> {
    /// Writes it whole: for what never grows.
    pub fn put(self, value: T) -> Result<(), Code> {
        if self.0.is_null() {
            return Err(Code::ERROR_NULL);
        }
        // SAFETY: not null, hence a `T`.
        unsafe { self.0.write_unaligned(value) };
        Ok(())
    }

    /// Writes it if it is wanted: where null is no mistake.
    pub fn offer(self, value: T) {
        let _ = self.put(value);
    }

    /// Refuses null, before any work is done.
    pub fn check(self) -> Result<(), Code> {
        if self.0.is_null() { Err(Code::ERROR_NULL) } else { Ok(()) }
    }
}

impl<T: Record> Out<T> {
    /// Refuses null, and a size that cannot be, before any work is done.
    pub fn check_record(self) -> Result<(), Code> {
        said_size::<T>(self.0.cast()).map(drop)
    }

    /// Reads what is there, as [`In::read`] does.
    pub fn current(self, defaults: T) -> Result<T, Code> {
        In(self.0.cast_const()).read(defaults)
    }

    /// Writes as much of it as the caller's struct says that it holds; that size stays.
    pub fn fill(self, value: &T) -> Result<(), Code> {
        let size = said_size::<T>(self.0.cast())?;
        self.copy(value, size)
    }

    /// Makes the caller's memory of `size` bytes such a struct. A tail that is not known here becomes zero.
    pub fn init(self, value: &T, size: u32) -> Result<(), Code> {
        self.check()?;
        let length = size as usize;
        if !(T::FIRST_SIZE..=LARGEST).contains(&length) {
            return Err(Code::ERROR_STRUCT);
        }
        // SAFETY: not null, and of that size.
        unsafe { self.0.cast::<u8>().write_bytes(0, length) };
        self.copy(value, length)
    }

    fn copy(self, value: &T, size: usize) -> Result<(), Code> {
        let said = u32::try_from(size).map_err(|_| Code::ERROR_STRUCT)?;
        let known = size.min(size_of::<T>());
        let to = self.0.cast::<u8>();
        // SAFETY: both are at least `known` bytes, and they do not overlap.
        unsafe { (&raw const *value).cast::<u8>().copy_to_nonoverlapping(to, known) };
        // SAFETY: every version of the struct has its size there.
        unsafe { to.add(T::SIZE_AT).cast::<u32>().write_unaligned(said) };
        Ok(())
    }
}

impl Text {
    /// No text.
    pub const NULL: Self = Self(std::ptr::null());
    /// An empty one.
    pub const EMPTY: Self = Self(c"".as_ptr());

    pub fn is_null(self) -> bool {
        self.0.is_null()
    }

    /// The text, borrowed for the call.
    pub fn read<'call>(self) -> Result<&'call str, Code> {
        if self.0.is_null() {
            return Err(Code::ERROR_NULL);
        }
        // SAFETY: not null, hence a text with a NUL, which nobody writes during the call.
        let text = unsafe { CStr::from_ptr(self.0) };
        text.to_str().map_err(|_| Code::ERROR_TEXT)
    }

    /// The text of `length` bytes; at 0 it goes to its NUL.
    pub fn read_bytes<'call>(self, length: usize) -> Result<&'call str, Code> {
        if length == 0 {
            return self.read();
        }
        if self.0.is_null() {
            return Err(Code::ERROR_NULL);
        }
        if isize::try_from(length).is_err() {
            return Err(Code::ERROR_VALUE);
        }
        // SAFETY: not null, hence `length` bytes, which nobody writes during the call.
        let bytes = unsafe { std::slice::from_raw_parts(self.0.cast::<u8>(), length) };
        std::str::from_utf8(bytes).map_err(|_| Code::ERROR_TEXT)
    }
}

/// A function of the host that takes lines of text.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct LogFunction(Option<unsafe extern "C" fn(u32, *const c_char, *mut c_void)>);

/// What the host wants it to be given.
#[repr(transparent)]
#[derive(Clone, Copy)]
pub struct LogUser(*mut c_void);

// SAFETY: it is handed back to the host alone, which says itself by which threads it polls.
unsafe impl Send for LogUser {}

impl LogUser {
    /// None.
    pub const NULL: Self = Self(std::ptr::null_mut());
}

impl LogFunction {
    /// None.
    pub const NULL: Self = Self(None);

    pub fn is_null(self) -> bool {
        self.0.is_none()
    }

    /// Tells it a line.
    pub fn tell(self, level: u32, text: &str, user: LogUser) {
        if let Some(function) = self.0 {
            let text = Shown::new(text);
            // SAFETY: the header asks for a function of this type, which returns.
            unsafe { function(level, text.text().0, user.0) };
        }
    }
}

/// A text that is made once and shown to C from then on. C texts end at a NUL, so that one inside becomes a space.
pub struct Shown(CString);

impl Shown {
    pub fn new(text: &str) -> Self {
        Self(CString::new(text.replace('\0', " ")).unwrap_or_default())
    }

    /// For C, which sees it for as long as `self` lives.
    pub fn text(&self) -> Text {
        Text(self.0.as_ptr())
    }
}

impl<T: Copy> Buffer<T> {
    /// Refuses null, before any work is done.
    pub fn check(self, capacity: usize, count: Out<usize>) -> Result<(), Code> {
        count.check()?;
        if capacity > 0 && self.0.is_null() { Err(Code::ERROR_NULL) } else { Ok(()) }
    }

    /// Writes the first `capacity` of `values`; null only with a capacity of 0.
    fn fill(self, capacity: usize, values: &[T]) -> Result<usize, Code> {
        let count = capacity.min(values.len());
        if capacity > 0 && self.0.is_null() {
            return Err(Code::ERROR_NULL);
        }
        if count > 0 {
            // SAFETY: not null, hence at least `capacity` elements; byte-wise, since it may be unaligned.
            unsafe {
                let from = values.as_ptr().cast::<u8>();
                from.copy_to_nonoverlapping(self.0.cast(), count * size_of::<T>());
            }
        }
        Ok(count)
    }

    /// Two-call enumeration: with a capacity of 0 only the count is told.
    pub fn enumerate(self, capacity: usize, count: Out<usize>, values: &[T]) -> Outcome {
        count.check()?;
        self.fill(capacity, values)?;
        count.put(values.len())?;
        Ok(told(capacity, values.len()))
    }
}

impl<T: Element> Buffer<T> {
    /// The same for structs that are `size` bytes each with the caller. What of them is not known here becomes zero.
    pub fn enumerate_sized(self, size: u32, capacity: usize, count: Out<usize>, values: &[T]) -> Outcome {
        self.check(capacity, count)?;
        let size = size as usize;
        if !(T::FIRST_SIZE..=LARGEST).contains(&size) {
            return Err(Code::ERROR_STRUCT);
        }
        let known = size.min(size_of::<T>());
        for (k, value) in values.iter().take(capacity).enumerate() {
            // SAFETY: not null, hence `capacity` structs of `size` bytes, and k is below that.
            unsafe {
                let to = self.0.cast::<u8>().add(k * size);
                to.write_bytes(0, size);
                (&raw const *value).cast::<u8>().copy_to_nonoverlapping(to, known);
            }
        }
        count.put(values.len())?;
        Ok(told(capacity, values.len()))
    }
}

impl Buffer<c_char> {
    /// The same for a text: the capacity counts the NUL, the length does not. What is cut off is whole letters.
    pub fn enumerate_text(self, capacity: usize, length: Out<usize>, text: &str) -> Outcome {
        length.check()?;
        if capacity > 0 {
            let cut = text.floor_char_boundary(capacity - 1);
            let mut bytes: Vec<c_char> = text.as_bytes()[..cut].iter().map(|b| *b as c_char).collect();
            bytes.push(0);
            self.fill(capacity, &bytes)?;
        }
        length.put(text.len())?;
        Ok(told(capacity, text.len() + 1))
    }
}

fn told(capacity: usize, all: usize) -> Code {
    if capacity == 0 || capacity >= all { Code::OK } else { Code::REMARK_MORE }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[repr(C)]
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Grown {
        size: u32,
        a: u32,
        b: u32,
    }

    // SAFETY: as the trait asks.
    unsafe impl Record for Grown {
        const SIZE_AT: usize = 0;
        const FIRST_SIZE: usize = 8;
    }

    const DEFAULTS: Grown = Grown { size: 12, a: 1, b: 2 };

    #[test]
    fn a_shorter_struct_takes_the_defaults_of_its_missing_tail() {
        let short = [8_u32, 7, 99];
        let read = In(short.as_ptr().cast::<Grown>()).read(DEFAULTS).unwrap();
        assert_eq!(read, Grown { size: 8, a: 7, b: 2 });
    }

    #[test]
    fn a_longer_struct_is_taken_if_its_unknown_tail_is_zero() {
        let mut long = [16_u32, 7, 8, 0];
        assert_eq!(In(long.as_ptr().cast::<Grown>()).read(DEFAULTS).map(|g| g.b), Ok(8));
        long[3] = 1;
        assert_eq!(In(long.as_ptr().cast::<Grown>()).read(DEFAULTS), Err(Code::ERROR_UNSUPPORTED));
    }

    #[test]
    fn sizes_that_cannot_be_are_refused() {
        for size in [0_u32, 7, 4097, u32::MAX] {
            let bad = [size, 0, 0];
            assert_eq!(In(bad.as_ptr().cast::<Grown>()).read(DEFAULTS), Err(Code::ERROR_STRUCT));
        }
        assert_eq!(In(std::ptr::null::<Grown>()).read(DEFAULTS), Err(Code::ERROR_NULL));
    }

    #[test]
    fn a_shorter_output_gets_only_what_it_knows() {
        let mut memory = [8_u32, 0, 99];
        Out(memory.as_mut_ptr().cast::<Grown>()).fill(&DEFAULTS).unwrap();
        assert_eq!(memory, [8, 1, 99]);
        let mut memory = [5_u32; 5];
        Out(memory.as_mut_ptr().cast::<Grown>()).init(&DEFAULTS, 16).unwrap();
        assert_eq!(memory, [16, 1, 2, 0, 5]);
    }

    impl Element for Grown {
        const FIRST_SIZE: usize = 8;
    }

    #[test]
    fn elements_are_as_far_apart_as_the_caller_says() {
        let values = [Grown { size: 1, a: 2, b: 3 }, Grown { size: 4, a: 5, b: 6 }];
        let (mut memory, mut count) = ([9_u32; 9], 0);
        let (to, out) = (Buffer(memory.as_mut_ptr().cast::<Grown>()), Out(&raw mut count));
        assert_eq!(to.enumerate_sized(8, 2, out, &values), Ok(Code::OK));
        assert_eq!((memory[..5].to_vec(), count), (vec![1, 2, 4, 5, 9], 2));
        assert_eq!(to.enumerate_sized(16, 2, out, &values), Ok(Code::OK));
        assert_eq!(memory, [1, 2, 3, 0, 4, 5, 6, 0, 9]);
        memory = [9; 9];
        let to = Buffer(memory.as_mut_ptr().cast::<Grown>());
        assert_eq!(to.enumerate_sized(12, 1, out, &values), Ok(Code::REMARK_MORE));
        assert_eq!((memory[..4].to_vec(), count), (vec![1, 2, 3, 9], 2));
        for size in [0, 7, 4097, u32::MAX] {
            assert_eq!(to.enumerate_sized(size, 2, out, &values), Err(Code::ERROR_STRUCT));
        }
        assert_eq!(Buffer::<Grown>(std::ptr::null_mut()).enumerate_sized(12, 0, out, &values), Ok(Code::OK));
    }

    #[test]
    fn texts_are_cut_between_letters() {
        let mut buffer = [1 as c_char; 8];
        let mut length = 0;
        let (to, out) = (Buffer(buffer.as_mut_ptr()), Out(&raw mut length));
        assert_eq!(to.enumerate_text(3, out, "aé"), Ok(Code::REMARK_MORE));
        assert_eq!((buffer[..3].to_vec(), length), (vec![b'a' as c_char, 0, 1], 3));
        assert_eq!(to.enumerate_text(4, out, "aé"), Ok(Code::OK));
        assert_eq!(buffer[3], 0);
    }
}
