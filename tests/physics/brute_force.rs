//! Sliders one by one, each with its own position: the slow truth.

/// Every slider's spring and friction element written out.
pub struct BruteSliders {
    weight: Vec<f64>,
    slip_at: Vec<f64>,
    elastic: f64,
    /// x_j, position of each friction element.
    position: Vec<f64>,
    pub slip: f64,
    pub dissipation: f64,
}

impl BruteSliders {
    pub fn new(weight: &[f64], slip_at: &[f64], elastic: f64) -> BruteSliders {
        BruteSliders {
            weight: weight.to_vec(),
            slip_at: slip_at.to_vec(),
            elastic,
            position: vec![0.0; weight.len()],
            slip: 0.0,
            dissipation: 0.0,
        }
    }

    pub fn force(&self) -> f64 {
        let stretched = self.weight.iter().zip(&self.position);
        let sliders: f64 = stretched.map(|(w, x)| w * (self.slip - x)).sum();
        sliders + self.elastic * self.slip
    }

    pub fn stored_energy(&self) -> f64 {
        let stretched = self.weight.iter().zip(&self.position);
        let sliders: f64 = stretched.map(|(w, x)| w * (self.slip - x).powi(2)).sum();
        (sliders + self.elastic * self.slip * self.slip) / 2.0
    }

    /// Moves the common end to `slip`; each element is dragged by what exceeds its reach.
    pub fn drive_slip(&mut self, slip: f64) {
        self.slip = slip;
        for ((w, d), x) in self
            .weight
            .iter()
            .zip(&self.slip_at)
            .zip(&mut self.position)
        {
            let stretch = slip - *x;
            if stretch.abs() > *d {
                let dragged = slip - d * stretch.signum();
                self.dissipation += w * d * (dragged - *x).abs();
                *x = dragged;
            }
        }
    }

    /// Finds the slip that carries `force`: lets the sliders go one after the other.
    pub fn drive_force(&mut self, force: f64) {
        let from = self.force();
        if force == from {
            return;
        }
        let direction = (force - from).signum();
        let mut order: Vec<usize> = (0..self.weight.len()).collect();
        let way = |j: &usize| self.slip_at[*j] - direction * (self.slip - self.position[*j]);
        order.sort_by(|a, b| way(a).total_cmp(&way(b)));
        let lets_go = |j: usize| self.position[j] + direction * self.slip_at[j];
        // Equilibrium with the first n in that order sliding:
        // F = Σ_sliding ±w d + Σ_sticking w (u − x) + S u, summed afresh for each n.
        let slip = (0..=order.len()).map(|n| {
            let (sliding, sticking) = order.split_at(n);
            let drag: f64 = sliding
                .iter()
                .map(|&j| self.weight[j] * self.slip_at[j])
                .sum();
            let offset: f64 = sticking
                .iter()
                .map(|&j| self.weight[j] * self.position[j])
                .sum();
            let held: f64 = sticking.iter().map(|&j| self.weight[j]).sum();
            (
                n,
                (force - direction * drag + offset) / (held + self.elastic),
            )
        });
        // The first n whose next slider still holds.
        let (_, slip) = slip
            .into_iter()
            .find(|&(n, slip)| n == order.len() || direction * (slip - lets_go(order[n])) <= 0.0)
            .expect("the last n has no next slider");
        self.drive_slip(slip);
    }
}
