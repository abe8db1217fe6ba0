//! A finite set of sliders: the discrete density, and the cells of every other one.

/// Sliders in parallel, sorted by the displacement at which they slip, with an elastic remainder.
///
/// Slider j is a spring `w_j` \[N/m\] in series with a friction element of strength `w_j d_j` \[N\].
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sliders {
    /// `w_j` \[N/m\], positive.
    pub weight: Vec<f64>,
    /// `d_j` \[m\], the slip displacement at which slider j lets go; increasing.
    pub slip_at: Vec<f64>,
    /// `S_∞` \[N/m\], stiffness that remains after every slider has slipped; zero at full slip.
    pub elastic: f64,
}
