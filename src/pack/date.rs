//! The day of a joint as XML asks for it.

/// A date or a date with time of joint.json, where hands may have written anything, as the
/// `xs:dateTime` of modelDescription.xml; a day alone begins at midnight. `None` for any other text,
/// by which strict importers would refuse the archive.
pub fn date_time(text: &str) -> Option<String> {
    let (date, time) = text.split_once('T').unwrap_or((text, "00:00:00Z"));
    let [year, month, day] = numbers(date, '-', [4, 2, 2])?;
    let leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
    let days = match month {
        2 if leap => 29,
        2 => 28,
        4 | 6 | 9 | 11 => 30,
        1..=12 => 31,
        _ => return None,
    };
    let clock = match time.strip_suffix('Z') {
        Some(clock) => clock,
        None => {
            let zone = time.rfind(['+', '-']);
            let (clock, offset) = zone.map_or((time, None), |at| (&time[..at], time.get(at + 1..)));
            if let Some(offset) = offset {
                let [hours, minutes] = numbers(offset, ':', [2, 2])?;
                (hours <= 13 && minutes <= 59).then_some(())?;
            }
            clock
        }
    };
    let (clock, fraction) = clock.split_once('.').unwrap_or((clock, "0"));
    let [hour, minute, second] = numbers(clock, ':', [2, 2, 2])?;
    let digits = !fraction.is_empty() && fraction.bytes().all(|byte| byte.is_ascii_digit());
    let within = (1..=days).contains(&day) && hour <= 23 && minute <= 59 && second <= 59;
    (year > 0 && within && digits).then(|| format!("{date}T{time}"))
}

/// As many numbers as asked for, of so many digits each.
fn numbers<const N: usize>(text: &str, between: char, digits: [usize; N]) -> Option<[u32; N]> {
    let mut parts = text.split(between);
    let mut numbers = [0; N];
    for (number, digits) in numbers.iter_mut().zip(digits) {
        let part = parts.next()?;
        let plain = part.len() == digits && part.bytes().all(|byte| byte.is_ascii_digit());
        *number = plain.then(|| part.parse().ok())??;
    }
    parts.next().is_none().then_some(numbers)
}

#[cfg(test)]
mod tests {
    use super::date_time;

    #[test]
    fn a_date_with_time_stays_and_a_day_begins_at_midnight() {
        for text in [
            "2024-05-01T12:00:00Z",
            "2024-02-29T23:59:59.125+02:00",
            "2024-05-01T12:00:00",
            "1999-12-31T00:00:00-13:30",
        ] {
            assert_eq!(date_time(text).as_deref(), Some(text));
        }
        let midnight = date_time("2024-05-01");
        assert_eq!(midnight.as_deref(), Some("2024-05-01T00:00:00Z"));
    }

    #[test]
    fn any_other_text_is_none() {
        for text in [
            "",
            "yesterday",
            "1. 5. 2024",
            "05/01/2024",
            "2024-13-01",
            "2023-02-29",
            "2024-05-00",
            "0000-05-01",
            "2024-5-1",
            "2024-05-01T",
            "2024-05-01T24:00:00Z",
            "2024-05-01T12:00Z",
            "2024-05-01T12:00:00.Z",
            "2024-05-01T12:00:00+25:00",
            "2024-05-01T12:00:00Z and a word",
            "2024-05-01 12:00:00",
            "２０２４-05-01",
        ] {
            assert_eq!(date_time(text), None, "{text}");
        }
    }
}
