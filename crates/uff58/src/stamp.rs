//! Dates and times of a universal file.

use std::time::{SystemTime, UNIX_EPOCH};

/// Date `DD-MMM-YY` and time `HH:MM:SS`, as texts.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Stamp {
    /// As `05-MAR-24`, empty where unknown.
    pub date: String,
    /// As `14:07:33`, empty where unknown.
    pub time: String,
}

const MONTHS: [(&str, u64); 12] = [
    ("JAN", 31),
    ("FEB", 28),
    ("MAR", 31),
    ("APR", 30),
    ("MAY", 31),
    ("JUN", 30),
    ("JUL", 31),
    ("AUG", 31),
    ("SEP", 30),
    ("OCT", 31),
    ("NOV", 30),
    ("DEC", 31),
];

impl Stamp {
    /// A time in seconds since 1970 began (UTC, without leap seconds); the year in two digits.
    pub fn at(seconds: u64) -> Self {
        let leaps = |year: u64| {
            year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400))
        };
        let (mut day, second) = (seconds / 86_400, seconds % 86_400);
        // 400 years have the same days every time.
        day %= 146_097;
        let mut year = 1970;
        while day >= 365 + u64::from(leaps(year)) {
            day -= 365 + u64::from(leaps(year));
            year += 1;
        }
        let mut month = "";
        for (name, days) in MONTHS {
            month = name;
            let days = days + u64::from(name == "FEB" && leaps(year));
            if day < days {
                break;
            }
            day -= days;
        }
        Self {
            date: format!("{:02}-{month}-{:02}", day + 1, year % 100),
            time: format!("{:02}:{:02}:{:02}", second / 3600, second / 60 % 60, second % 60),
        }
    }

    /// Now, by the clock of this machine.
    pub fn now() -> Self {
        let since = SystemTime::now().duration_since(UNIX_EPOCH);
        Self::at(since.map_or(0, |time| time.as_secs()))
    }

    /// 1 January 1970, for files that must not depend on the day.
    pub fn fixed() -> Self {
        Self::at(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        for (seconds, date, time) in [
            (0, "01-JAN-70", "00:00:00"),
            (68_256_000, "01-MAR-72", "00:00:00"),
            (68_255_999, "29-FEB-72", "23:59:59"),
            (951_782_400, "29-FEB-00", "00:00:00"),
            (978_307_199, "31-DEC-00", "23:59:59"),
            (1_700_000_000, "14-NOV-23", "22:13:20"),
            (4_107_542_400, "01-MAR-00", "00:00:00"),
        ] {
            let stamp = Stamp::at(seconds);
            assert_eq!((&*stamp.date, &*stamp.time), (date, time), "{seconds}");
        }
        // Any number of seconds is some day.
        assert_eq!(Stamp::at(u64::MAX).date.len(), 9);
    }
}
