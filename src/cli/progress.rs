//! Progress on the standard error: each stage as it begins, and that it still runs while it is long.

use super::output;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// Time between two words on a stage that goes on.
const STILL: Duration = Duration::from_secs(2);

/// Times that many later.
const LONGER: u32 = 5;

/// Words on a stage after which they come further apart.
const SOON: u32 = 5;

/// Tells stages with the seconds since it was made; ends with it.
pub struct Progress {
    stages: Option<Sender<String>>,
    telling: Option<JoinHandle<()>>,
}

impl Progress {
    /// Begins to count the seconds.
    pub fn new() -> Progress {
        let start = Instant::now();
        let (stages, told) = channel::<String>();
        let telling = thread::spawn(move || {
            let tell = |words: &str| {
                let seconds = start.elapsed().as_secs_f64();
                output::tell(&format!("[{seconds:6.2} s] {words}"));
            };
            let (mut stage, mut words) = (String::new(), 0);
            loop {
                let wait = if words < SOON { STILL } else { LONGER * STILL };
                match told.recv_timeout(wait) {
                    Ok(next) => {
                        tell(&next);
                        (stage, words) = (next, 0);
                    }
                    Err(RecvTimeoutError::Timeout) if stage.is_empty() => {}
                    Err(RecvTimeoutError::Timeout) => {
                        tell(&format!("… {stage}"));
                        words += 1;
                    }
                    Err(RecvTimeoutError::Disconnected) => return,
                }
            }
        });
        Progress {
            stages: Some(stages),
            telling: Some(telling),
        }
    }

    /// A stage begins.
    pub fn stage(&self, words: &str) {
        if let Some(stages) = &self.stages {
            // Who tells it ends with this value, so somebody listens.
            let _ = stages.send(words.to_string());
        }
    }
}

impl Drop for Progress {
    /// Waits until all that was said is told.
    fn drop(&mut self) {
        drop(self.stages.take());
        if let Some(telling) = self.telling.take() {
            // A panic there is no reason for another one here.
            let _ = telling.join();
        }
    }
}
