//! The exact response: a stack of turning points, no discretisation.

use super::density::Density;
use super::simulation::JointError;
use super::turnings::{Forgotten, Turning, Turnings};
use super::virgin::VirginCurve;

/// A network under prescribed force or slip, by Masing's rule with return-point memory.
///
/// ```text
/// virgin    F = s G(|u|)                              E = d(|u|)
/// branch    u = u_r + s 2 H(|F − F_r|/2), s = ±1      E += 2 d(|u − u_r|/2)
/// closure   the previous turning point is passed: the pair goes, its loop has lost 4 d(|u_r − u_{r−1}|/2)
/// opposite  −F_1 is passed, F_1 the largest ever: virgin again, 2 d(|u_1|) has been lost since
/// ```
/// The branch law is Eq. 36, 37 with their limits mended: it holds for `|F| < F_M`, and the
/// integrals end at `k F_M/K_T`. The answer depends on the sequence of turning values only, and a
/// zero increment changes nothing. Amortised O(1) per step for the parametric densities,
/// O(log N) for N sliders. Checked against brute-force sliders in tests/physics.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactResponse<C = Density> {
    curve: C,
    turnings: Turnings,
    force: f64,
    slip: f64,
    /// Sign of the last step that moved; 0 before the first.
    direction: f64,
    open: f64,
    stored: f64,
    /// Loss of the loops that have closed \[J\].
    closed: f64,
    dissipation: f64,
    /// Sum of the gaps in the memory, in slip \[m\] and in force \[N\].
    gaps: (f64, f64),
}

/// Numbers of state before the turning points, and per turning point.
const HEAD: usize = 9;
const PER_TURNING: usize = 4;

impl<C: VirginCurve> ExactResponse<C> {
    /// A virgin network at zero force and slip, that remembers whatever the history asks.
    pub fn new(curve: C) -> ExactResponse<C> {
        ExactResponse::remembering(curve, None)
    }

    /// A virgin network that remembers at most `most` turning points (four at least) and never
    /// allocates again.
    ///
    /// Up to there it is [`ExactResponse::new`] to the last bit. A reversal that finds no room
    /// pushes out the loop `(r_i, r_i+1)` that lies closest between its neighbours: it is booked as
    /// closed, `4 d`, and the memory has a gap between `r_i−1` and `r_i+2`, of the size
    ///
    /// ```text
    /// force-driven  g = e(i−1, i+2) − e(i−1, i) + e(i, i+1) − e(i+1, i+2),  e(i, j) = |u_i − u_j| − 2 H(|F_i − F_j|/2)
    /// slip-driven   the same with                                           e(i, j) = 2 G(|u_i − u_j|/2) − |F_i − F_j|
    /// ```
    /// (`e` is zero where nothing has been forgotten). Whatever the load does afterwards, the answer
    /// is off by no more than the sum of the gaps since the load was last beyond all of its past;
    /// there it is exact again, and the sum begins anew: [`ExactResponse::error_bound`].
    ///
    /// For the network is a sum of plays over its input, each of which keeps the order of two
    /// histories and never moves them further apart. A memory with one loop forgotten differs from
    /// the whole one by plays that all lie to the same side and make up `g` together, and by `g`
    /// itself, added so that the answer does not jump: by something between nothing and `g`. Of
    /// that sum only the gaps count that the load has entered and not left, as a rule one, so that
    /// the answer is far nearer as a rule. Checked in tests/physics/bounded.rs.
    pub fn bounded(curve: C, most: usize) -> ExactResponse<C> {
        ExactResponse::remembering(curve, Some(most))
    }

    fn remembering(curve: C, most: Option<usize>) -> ExactResponse<C> {
        ExactResponse {
            curve,
            turnings: Turnings::new(most),
            force: 0.0,
            slip: 0.0,
            direction: 0.0,
            open: 0.0,
            stored: 0.0,
            closed: 0.0,
            dissipation: 0.0,
            gaps: (0.0, 0.0),
        }
    }

    /// Takes the next force \[N\].
    ///
    /// # Errors
    /// [`JointError::BeyondFullSlip`] at and beyond F_S, [`JointError::OutOfRange`] for a force that
    /// is no finite number; the state is then as before.
    pub fn drive_force(&mut self, force: f64) -> Result<(), JointError> {
        let full_slip = self.curve.full_slip_force();
        if !force.is_finite() {
            return Err(JointError::OutOfRange {
                name: "force".into(),
                value: force,
                lower: -full_slip,
                upper: full_slip,
            });
        }
        if force.abs() >= full_slip {
            return Err(JointError::BeyondFullSlip { force, full_slip });
        }
        if force == self.force {
            return Ok(());
        }
        self.turn((force - self.force).signum());
        self.close(force, |turning| turning.force);
        self.force = force;
        self.slip = match self.turnings.last() {
            None => self.direction * self.curve.displacement(force.abs()),
            Some(from) => {
                let way = self.curve.displacement((force - from.force).abs() / 2.0);
                from.slip + self.direction * 2.0 * way
            }
        };
        self.account();
        Ok(())
    }

    /// Takes the next slip displacement u \[m\] of the network. A value that is no finite number is
    /// no motion: simulations refuse it before.
    pub fn drive_slip(&mut self, slip: f64) {
        if slip == self.slip || !slip.is_finite() {
            return;
        }
        self.turn((slip - self.slip).signum());
        self.close(slip, |turning| turning.slip);
        self.slip = slip;
        self.force = match self.turnings.last() {
            None => self.direction * self.curve.force(slip.abs()),
            Some(from) => {
                let half = self.curve.force((slip - from.slip).abs() / 2.0);
                from.force + self.direction * 2.0 * half
            }
        };
        self.account();
    }

    /// F \[N\].
    pub fn force(&self) -> f64 {
        self.force
    }

    /// u \[m\].
    pub fn slip(&self) -> f64 {
        self.slip
    }

    /// Energy dissipated since the virgin state \[J\], the branch in progress included; never falls.
    pub fn dissipation(&self) -> f64 {
        self.dissipation
    }

    /// Energy in the springs of the network \[J\]: the work ∫F du less the dissipation. Along a
    /// branch it changes by `(F + F_r)(u − u_r)/2`, on the virgin curve it is `(F u − d(u))/2`.
    pub fn stored_energy(&self) -> f64 {
        self.stored
    }

    /// dF/du \[N/m\] for going on in the direction of the last step.
    pub fn tangent_stiffness(&self) -> f64 {
        self.curve.stiffness(self.way())
    }

    /// d(dissipation)/du \[N\] for going on in the direction of the last step: what the sliding
    /// part carries, `s d'(|u − u_r|/2) = s Λ_1(k|u − u_r|/2)`. The rest of F goes into the springs:
    /// `d(stored)/du = F − d(dissipation)/du`.
    pub fn sliding_force(&self) -> f64 {
        self.direction * self.curve.slipped_force(self.way())
    }

    /// [`ExactResponse::sliding_force`] where the tangent \[N/m\] is known, without asking the curve:
    /// `Λ_1 = G − u G'` with `G = |F − F_r|/2` on a branch.
    pub fn sliding_force_with(&self, tangent: f64) -> f64 {
        let force = match self.turnings.last() {
            None => self.force.abs(),
            Some(from) => (self.force - from.force).abs() / 2.0,
        };
        self.direction * (force - self.way() * tangent)
    }

    /// The virgin curve's argument \[m\] at the present point.
    fn way(&self) -> f64 {
        match self.turnings.last() {
            None => self.slip.abs(),
            Some(from) => (self.slip - from.slip).abs() / 2.0,
        }
    }

    /// Count of turning points remembered.
    pub fn depth(&self) -> usize {
        self.turnings.as_slice().len()
    }

    /// By how much the answer of a bounded memory may be off, in slip \[m\] under force and in force
    /// \[N\] under slip; zero while it has room, and again once the load is beyond all of its past.
    pub fn error_bound(&self) -> (f64, f64) {
        self.gaps
    }

    /// The curve it moves on.
    pub fn curve(&self) -> &C {
        &self.curve
    }

    /// Complete state as numbers; [`ExactResponse::restore`] continues identically, to the last bit.
    pub fn state(&self) -> Vec<f64> {
        let mut state = Vec::with_capacity(HEAD + PER_TURNING * self.depth());
        state.extend([self.force, self.slip, self.direction, self.open]);
        state.extend([self.stored, self.closed, self.dissipation]);
        state.extend([self.gaps.0, self.gaps.1]);
        for t in self.turnings.as_slice() {
            state.extend([t.force, t.slip, t.open, t.stored]);
        }
        state
    }

    /// Puts back a state saved from the same curve.
    ///
    /// # Errors
    /// [`JointError::ForeignState`] where the length, a value or the place on the curve does not
    /// fit; the state is then as before.
    pub fn restore(&mut self, state: &[f64]) -> Result<(), JointError> {
        let foreign = |reason: &str| JointError::ForeignState {
            reason: reason.into(),
        };
        let (head, tail) = state
            .split_at_checked(HEAD)
            .filter(|(_, tail)| tail.len() % PER_TURNING == 0)
            .ok_or_else(|| foreign(&format!("{} numbers", state.len())))?;
        if !state.iter().all(|value| value.is_finite()) {
            return Err(foreign("a value is no finite number"));
        }
        let &[
            force,
            slip,
            direction,
            open,
            stored,
            closed,
            dissipation,
            by_slip,
            by_force,
        ] = head
        else {
            return Err(foreign("too short"));
        };
        let at_rest = direction == 0.0 && force == 0.0 && slip == 0.0 && tail.is_empty();
        if direction.abs() != 1.0 && !at_rest {
            return Err(foreign("no direction of motion"));
        }
        let turnings = tail.chunks_exact(PER_TURNING).map(|t| Turning {
            force: t[0],
            slip: t[1],
            open: t[2],
            stored: t[3],
        });
        if !self.turnings.holds(turnings.len()) {
            let count = turnings.len();
            return Err(foreign(&format!("{count} turning points find no room")));
        }
        let (factor, from) = match turnings.clone().next_back() {
            None => (1.0, (0.0, 0.0)),
            Some(from) => (2.0, (from.force, from.slip)),
        };
        let way = (slip - from.1).abs();
        let expected = from.0 + direction * factor * self.curve.force(way / factor);
        // Force and slip of a saved state satisfy the curve to rounding; another joint's do not.
        let scale = self.curve.initial_stiffness() * way + from.0.abs() + force.abs();
        if (expected - force).abs() > 1e-6 * scale {
            return Err(foreign("force and slip are not on this joint's curve"));
        }
        self.turnings.replace(turnings);
        (self.force, self.slip, self.direction) = (force, slip, direction);
        (self.open, self.stored) = (open, stored);
        (self.closed, self.dissipation) = (closed, dissipation);
        self.gaps = (by_slip, by_force);
        Ok(())
    }

    /// Remembers the present point where the direction changes.
    fn turn(&mut self, direction: f64) {
        if self.direction == -direction {
            let here = Turning {
                force: self.force,
                slip: self.slip,
                open: self.open,
                stored: self.stored,
            };
            if let Some(forgotten) = self.turnings.remember(here) {
                self.forget(forgotten);
            }
        }
        self.direction = direction;
    }

    /// Books a loop that found no room, and the gap that it leaves.
    fn forget(&mut self, forgotten: Forgotten) {
        let [first, second] = forgotten.loop_ends;
        let loss = 4.0
            * self
                .curve
                .leg_dissipation((first.slip - second.slip).abs() / 2.0);
        // What was lost stays lost: closed from now on, no longer open.
        self.closed += loss;
        self.turnings.book(forgotten.place, loss);
        let (outside, inside) = (forgotten.outside, forgotten.inside);
        let ends = [
            outside, inside, outside, first, first, second, second, inside,
        ];
        let [merged, before, within, after] =
            [0, 2, 4, 6].map(|place| self.excess(ends[place], ends[place + 1]));
        let gap = |of: fn(&(f64, f64)) -> f64| {
            // Rounding makes less than nothing of a gap that is hardly there.
            (of(&merged) - of(&before) + of(&within) - of(&after)).max(0.0)
        };
        self.gaps.0 += gap(|excess| excess.0);
        self.gaps.1 += gap(|excess| excess.1);
    }

    /// What the way between two neighbours in the memory has beyond a branch of the curve, in slip
    /// \[m\] for its force, and what it lacks in force \[N\] for its slip.
    fn excess(&self, one: Turning, other: Turning) -> (f64, f64) {
        let (force, slip) = (
            (one.force - other.force).abs(),
            (one.slip - other.slip).abs(),
        );
        (
            slip - 2.0 * self.curve.displacement(force / 2.0),
            2.0 * self.curve.force(slip / 2.0) - force,
        )
    }

    /// Forgets the loops that close on the way to `target` (force or slip, as `of` reads it).
    fn close(&mut self, target: f64, of: impl Fn(&Turning) -> f64) {
        loop {
            match self.turnings.as_slice() {
                [first] if self.direction * target >= of(first).abs() => {
                    self.closed += 2.0 * self.curve.leg_dissipation(first.slip.abs());
                    self.turnings.clear();
                    self.gaps = (0.0, 0.0);
                }
                [.., outer, inner] if self.direction * (target - of(outer)) >= 0.0 => {
                    let amplitude = (inner.slip - outer.slip).abs() / 2.0;
                    self.closed += 4.0 * self.curve.leg_dissipation(amplitude);
                    self.turnings.forget_loop();
                }
                _ => return,
            }
        }
    }

    /// Energies at the present point of the curve.
    fn account(&mut self) {
        match self.turnings.last() {
            None => {
                let slip = self.slip.abs();
                self.open = self.curve.leg_dissipation(slip);
                self.stored = (self.force.abs() * slip - self.open) / 2.0;
            }
            Some(from) => {
                let way = self.slip - from.slip;
                self.open = from.open + 2.0 * self.curve.leg_dissipation(way.abs() / 2.0);
                self.stored = from.stored + (self.force + from.force) * way / 2.0;
            }
        }
        // The sum is re-associated at a closure; rounding there must not take energy back.
        self.dissipation = self.dissipation.max(self.closed + self.open);
    }
}
