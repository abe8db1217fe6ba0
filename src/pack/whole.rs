//! Whether a library is all there: half of one has a whole one's head, and ends the program that loads it.

/// Bytes that a library's own tables ask for; `None` where its format keeps none that are known here,
/// or the file ends before them: there it has no stamp either.
pub fn length(bytes: &[u8]) -> Option<u64> {
    if bytes.starts_with(b"\x7fELF") {
        end_of_elf(bytes)
    } else if bytes.starts_with(b"MZ") {
        end_of_pe(bytes)
    } else {
        None
    }
}

/// End of the table of sections, which linkers write last; of 32 or 64 bits, little-endian.
fn end_of_elf(bytes: &[u8]) -> Option<u64> {
    let is_64 = bytes.get(4) == Some(&2);
    let (begin, size, count) = if is_64 {
        (long(bytes, 40)?, short(bytes, 58)?, short(bytes, 60)?)
    } else {
        (word(bytes, 32)?, short(bytes, 46)?, short(bytes, 48)?)
    };
    Some(begin.saturating_add(size * count))
}

/// End of the last section in the file; byte 60 holds where the head is.
fn end_of_pe(bytes: &[u8]) -> Option<u64> {
    let head = usize::try_from(word(bytes, 60)?).ok()?;
    let count = short(bytes, head.checked_add(6)?)?;
    let options = short(bytes, head.checked_add(20)?)?;
    let table = head.checked_add(24 + usize::try_from(options).ok()?)?;
    let mut end = 0;
    for section in 0..usize::try_from(count).ok()? {
        let row = table.checked_add(40 * section)?;
        end = end.max(word(bytes, row + 16)? + word(bytes, row + 20)?);
    }
    Some(end)
}

fn short(bytes: &[u8], at: usize) -> Option<u64> {
    number(bytes, at, 2)
}

fn word(bytes: &[u8], at: usize) -> Option<u64> {
    number(bytes, at, 4)
}

fn long(bytes: &[u8], at: usize) -> Option<u64> {
    number(bytes, at, 8)
}

/// The little-endian number of so many bytes.
fn number(bytes: &[u8], at: usize, size: usize) -> Option<u64> {
    let digits = bytes.get(at..at.checked_add(size)?)?.iter().rev();
    Some(digits.fold(0, |sum, digit| sum << 8 | u64::from(*digit)))
}

#[cfg(test)]
mod tests {
    use super::length;

    #[test]
    fn the_tables_of_both_formats_are_read() {
        let mut elf = vec![0; 64];
        elf[..5].copy_from_slice(b"\x7fELF\x02");
        (elf[41], elf[58], elf[60]) = (3, 64, 5);
        assert_eq!(length(&elf), Some(3 * 256 + 64 * 5));
        (elf[4], elf[33], elf[46], elf[48]) = (1, 2, 40, 3);
        assert_eq!(length(&elf), Some(2 * 256 + 40 * 3));
        let mut pe = vec![0; 256];
        pe[..2].copy_from_slice(b"MZ");
        (pe[60], pe[64 + 6], pe[64 + 20]) = (64, 2, 8);
        for (section, begin, size) in [(0, 2, 4), (1, 6, 1)] {
            let row = 64 + 24 + 8 + 40 * section;
            (pe[row + 17], pe[row + 21]) = (size, begin);
        }
        assert_eq!(length(&pe), Some(7 * 256));
        assert_eq!(length(b"\x7fELF\x02"), None);
        assert_eq!(length(b"\xcf\xfa\xed\xfe"), None);
    }
}
