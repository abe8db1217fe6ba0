//! A history cut into branches once, so that a fit evaluates the virgin curve only.

/// Where one sample lies: on the virgin curve, or on a branch from an earlier reversal.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Place {
    /// Sample of the reversal; `None` on the virgin curve.
    from: Option<usize>,
    /// |x| on the virgin curve, |x − x_r|/2 on a branch.
    way: f64,
    /// +1 or −1.
    sign: f64,
}

/// The branches of one driven channel.
///
/// Masing's rule with return-point memory (`u = u_r + s 2 H(|F − F_r|/2)`)
/// decides from the driven channel alone which reversal a sample belongs to; the curve enters
/// afterwards. A fit therefore sorts the history once and evaluates the curve as often as it
/// likes. Driven by force the curve is H(F) + F/K_1, driven by displacement its inverse.
#[derive(Debug, Clone, PartialEq)]
pub struct Branches {
    places: Vec<Place>,
    /// Samples whose value is wanted; reversals among their ancestors are kept besides.
    wanted: Vec<usize>,
    /// Samples to evaluate, rising: the wanted ones and all they descend from.
    needed: Vec<usize>,
}

impl Branches {
    /// Cuts a channel that starts from the virgin state; keeps every `stride`-th sample.
    pub fn of(channel: &[f64], stride: usize) -> Branches {
        let mut places: Vec<Place> = Vec::with_capacity(channel.len());
        let mut turnings: Vec<usize> = Vec::new();
        let mut last = 0.0;
        let mut direction = 0.0;
        for (i, &x) in channel.iter().enumerate() {
            if x == last {
                // A repeated sample changes nothing.
                let same = places.last().copied();
                places.push(same.unwrap_or(Place {
                    from: None,
                    way: 0.0,
                    sign: 1.0,
                }));
                continue;
            }
            let heading = (x - last).signum();
            // Before the first sample the joint rests at zero: no reversal there.
            if direction == -heading && i > 0 {
                turnings.push(i - 1);
            }
            direction = heading;
            loop {
                match turnings.as_slice() {
                    [first] if heading * x >= channel[*first].abs() => turnings.clear(),
                    [.., outer, _] if heading * (x - channel[*outer]) >= 0.0 => {
                        turnings.truncate(turnings.len() - 2);
                    }
                    _ => break,
                }
            }
            places.push(match turnings.last() {
                None => Place {
                    from: None,
                    way: x.abs(),
                    sign: heading,
                },
                Some(&r) => Place {
                    from: Some(r),
                    way: 0.5 * (x - channel[r]).abs(),
                    sign: heading,
                },
            });
            last = x;
        }
        let wanted: Vec<usize> = (0..channel.len()).step_by(stride.max(1)).collect();
        let mut keep = vec![false; channel.len()];
        for &i in &wanted {
            let mut at = Some(i);
            while let Some(j) = at.filter(|&j| !keep[j]) {
                keep[j] = true;
                at = places[j].from;
            }
        }
        let needed = (0..channel.len()).filter(|&i| keep[i]).collect();
        Branches {
            places,
            wanted,
            needed,
        }
    }

    /// The samples whose response [`Branches::respond`] returns.
    pub fn samples(&self) -> &[usize] {
        &self.wanted
    }

    /// Largest argument the curve is asked for.
    pub fn largest_way(&self) -> f64 {
        self.places.iter().map(|p| p.way).fold(0.0, f64::max)
    }

    /// The response at the wanted samples, for a virgin curve over non-negative arguments.
    pub fn respond(&self, curve: impl Fn(f64) -> f64) -> Vec<f64> {
        let mut value = vec![0.0; self.places.len()];
        for &i in &self.needed {
            let place = self.places[i];
            value[i] = match place.from {
                None => place.sign * curve(place.way),
                Some(r) => value[r] + place.sign * 2.0 * curve(place.way),
            };
        }
        self.wanted.iter().map(|&i| value[i]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::joint::{ExactResponse, FourParameter, VirginCurve};

    #[test]
    fn branches_answer_as_the_exact_memory_does() {
        let joint = FourParameter::new(100.0, 1e7, -0.4, 0.5).expect("in range");
        // An incommensurate two-tone with repeated samples: nested loops of many depths.
        let force: Vec<f64> = (0..4000)
            .map(|i| {
                let t = (i / 2) as f64 * 0.02;
                45.0 * (t.sin() + (6.3 * t).sin()) * (0.3 + 0.7 * (0.037 * t).sin())
            })
            .collect();
        let density = crate::joint::Density::FourParameter(joint);
        let mut memory = ExactResponse::new(density);
        let whole = Branches::of(&force, 1).respond(|f| joint_slip(&joint, f));
        let third = Branches::of(&force, 3).respond(|f| joint_slip(&joint, f));
        for (i, &f) in force.iter().enumerate() {
            memory.drive_force(f).expect("below full slip");
            assert!((memory.slip() - whole[i]).abs() < 1e-18, "sample {i}");
            if i % 3 == 0 {
                assert_eq!(whole[i], third[i / 3]);
            }
        }
    }

    fn joint_slip(joint: &FourParameter, force: f64) -> f64 {
        crate::joint::Density::FourParameter(*joint).displacement(force)
    }
}
