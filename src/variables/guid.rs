//! The GUID that binds modelDescription.xml to the joint and its drive.

use crate::joint::Drive;

/// GUID of a joint.json under a drive: FNV-1a (128 bits) over the text and the name of the drive,
/// written as `8-4-4-4-12` hexadecimal digits. It tells files apart that were mixed up; it is no
/// protection against forgery, which an FMU has no use for.
pub fn guid(joint_json: &str, drive: Drive) -> String {
    let hash = fnv1a(joint_json.bytes().chain([0]).chain(name(drive).bytes()));
    let digits = format!("{hash:032x}");
    let parts = [
        &digits[..8],
        &digits[8..12],
        &digits[12..16],
        &digits[16..20],
        &digits[20..],
    ];
    parts.join("-")
}

/// The drive for which `came` is the GUID of this joint.json; `None` where it is for neither.
pub fn drive_of(joint_json: &str, came: &str) -> Option<Drive> {
    [Drive::Force, Drive::Displacement]
        .into_iter()
        .find(|&drive| guid(joint_json, drive) == came)
}

fn name(drive: Drive) -> &'static str {
    match drive {
        Drive::Force => "force",
        Drive::Displacement => "displacement",
    }
}

/// Fowler–Noll–Vo hash 1a, 128 bits, with its published offset basis and prime.
fn fnv1a(bytes: impl Iterator<Item = u8>) -> u128 {
    const OFFSET: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    bytes.fold(OFFSET, |hash, byte| {
        (hash ^ u128::from(byte)).wrapping_mul(PRIME)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published values of FNV-1a 128: the empty text and `a` (draft-eastlake-fnv).
    #[test]
    fn hash_matches_published_values() {
        assert_eq!(fnv1a([].into_iter()), 0x6c62272e07bb014262b821756295c58d);
        assert_eq!(
            fnv1a(b"a".iter().copied()),
            0xd228cb696f1a8caf78912b704e4a8964
        );
    }

    #[test]
    fn guid_tells_drive_and_text_apart() {
        let text = "{\"version\": 1}";
        assert_eq!(
            drive_of(text, &guid(text, Drive::Displacement)),
            Some(Drive::Displacement)
        );
        assert_eq!(
            drive_of(text, &guid(text, Drive::Force)),
            Some(Drive::Force)
        );
        assert_eq!(
            drive_of("{\"version\": 2}", &guid(text, Drive::Force)),
            None
        );
    }
}
