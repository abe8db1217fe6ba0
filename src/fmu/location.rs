//! Where the host says that the resources are → folders to look in. Hosts disagree about its form, so
//! all that were seen are understood.

use std::path::PathBuf;

/// Why a resource location is not understood.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum LocationError {
    /// A scheme other than `file`.
    #[error("expected a file: URI or a path, came `{came}`")]
    Scheme {
        /// The location as it came.
        came: String,
    },
    /// Another machine.
    #[error("expected this machine (`localhost` or nothing), came host `{host}`")]
    Host {
        /// Authority of the URI.
        host: String,
    },
    /// Nothing after the scheme.
    #[error("expected the folder `resources`, came an empty path")]
    Empty,
}

/// Folders that the location may mean, most likely first: a URI percent-encoded as the standard asks,
/// then raw as some hosts send it; a path, which FMI 3.0 asks for, raw, then as if it were encoded.
///
/// Understood: `file:///p`, `file:////p`, `file:/p`, `file://localhost/p`, `/p`, each with or
/// without a trailing slash, and `file:///C:/p`; on Windows another machine's share, too,
/// `file://machine/share/p`.
pub fn folders(location: &str) -> Result<Vec<PathBuf>, LocationError> {
    folders_on(location, cfg!(windows))
}

/// [`folders`] on a system that has shares of other machines in its paths, or not.
fn folders_on(location: &str, has_shares: bool) -> Result<Vec<PathBuf>, LocationError> {
    let (path, is_uri) = match location.split_once(':') {
        Some((scheme, rest)) if scheme.eq_ignore_ascii_case("file") => {
            (path_of_uri(rest, has_shares)?, true)
        }
        // A single letter is a drive of Windows, not a scheme.
        Some((scheme, _)) if scheme.len() > 1 && !scheme.contains(['/', '\\']) => {
            return Err(LocationError::Scheme {
                came: location.to_owned(),
            });
        }
        _ => (location, false),
    };
    if path.is_empty() {
        return Err(LocationError::Empty);
    }
    let raw = PathBuf::from(path);
    Ok(match decoded(path).map(PathBuf::from) {
        Some(decoded) if decoded != raw && is_uri => vec![decoded, raw],
        Some(decoded) if decoded != raw => vec![raw, decoded],
        _ => vec![raw],
    })
}

/// Path of what follows `file:`.
fn path_of_uri(rest: &str, has_shares: bool) -> Result<&str, LocationError> {
    let path = match rest.strip_prefix("//") {
        None => rest,
        Some(after) => {
            let (host, path) = after.split_at(after.find('/').unwrap_or(after.len()));
            if !host.is_empty() && !host.eq_ignore_ascii_case("localhost") {
                if has_shares {
                    return Ok(rest); // `//machine/share/p` is a path there
                }
                return Err(LocationError::Host {
                    host: host.to_owned(),
                });
            }
            path
        }
    };
    let drive = path.trim_start_matches('/');
    let is_drive = drive
        .as_bytes()
        .first()
        .is_some_and(u8::is_ascii_alphabetic)
        && matches!(drive.as_bytes().get(1), Some(b':' | b'|'));
    Ok(if is_drive { drive } else { path })
}

/// The text with its `%41` decoded; `None` where a `%` is not followed by two hexadecimal digits
/// or the result is not UTF-8.
fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        rest = after;
        if first == b'%' {
            let digits = std::str::from_utf8(rest.get(..2)?).ok()?;
            bytes.push(
                u8::from_str_radix(digits, 16)
                    .ok()
                    .filter(|_| !digits.starts_with('+'))?,
            );
            rest = &rest[2..];
        } else {
            bytes.push(first);
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn first(location: &str) -> PathBuf {
        folders(location).unwrap().remove(0)
    }

    #[test]
    fn every_form_seen_in_importers_means_the_same_folder() {
        for form in [
            "file:///srv/a b/resources",
            "file:///srv/a%20b/resources",
            "file:////srv/a%20b/resources",
            "file:/srv/a%20b/resources",
            "file://localhost/srv/a%20b/resources/",
            "FILE:///srv/a%20b/resources/",
            "/srv/a b/resources",
        ] {
            // `PathBuf` compares by components: `//tmp` and a trailing slash mean the same.
            assert_eq!(first(form), PathBuf::from("/srv/a b/resources"), "{form}");
        }
        assert_eq!(
            first("file:///C:/a/resources"),
            PathBuf::from("C:/a/resources")
        );
        assert_eq!(first("C:/a/resources"), PathBuf::from("C:/a/resources"));
    }

    #[test]
    fn a_share_of_another_machine_is_a_path_where_there_are_any() {
        for location in ["file://rig/a b/resources", "file://rig/a%20b/resources"] {
            let found = folders_on(location, true).unwrap();
            assert_eq!(found[0], PathBuf::from("//rig/a b/resources"));
            let host = "rig".into();
            assert_eq!(
                folders_on(location, false),
                Err(LocationError::Host { host })
            );
        }
        let four = folders_on("file:////rig/a/resources", true).unwrap();
        assert_eq!(four, [PathBuf::from("//rig/a/resources")]);
        let local = folders_on("file://localhost/C:/a/resources", true).unwrap();
        assert_eq!(local, [PathBuf::from("C:/a/resources")]);
    }

    #[test]
    fn a_raw_percent_sign_is_found_too() {
        assert_eq!(
            folders("file:///a/100%/r").unwrap(),
            [PathBuf::from("/a/100%/r")]
        );
        let both = folders("file:///a/%41/r").unwrap();
        assert_eq!(both, [PathBuf::from("/a/A/r"), PathBuf::from("/a/%41/r")]);
        let path = folders("/a/%41/r").unwrap();
        assert_eq!(path, [PathBuf::from("/a/%41/r"), PathBuf::from("/a/A/r")]);
    }

    #[test]
    fn what_is_no_folder_is_told_apart() {
        let scheme = LocationError::Scheme {
            came: "http://a/b".into(),
        };
        assert_eq!(folders("http://a/b"), Err(scheme));
        assert_eq!(
            folders("file://there/b"),
            Err(LocationError::Host {
                host: "there".into()
            })
        );
        assert_eq!(folders("file://"), Err(LocationError::Empty));
        assert_eq!(folders(""), Err(LocationError::Empty));
    }
}
