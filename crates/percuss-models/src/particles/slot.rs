//! Slots in a body: where its particles do not stand.

/// A straight slot with round ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slot {
    /// Ends of its middle line [m].
    ends: [[f64; 2]; 2],
    /// Half of its width [m].
    half_width: f64,
}

impl Slot {
    /// A slot of a width [m] from one place to its tip.
    pub(super) fn new([from, tip]: [[f64; 2]; 2], width: f64) -> Self {
        let half_width = 0.5 * width;
        let way = [tip[0] - from[0], tip[1] - from[1]];
        // The round end touches the tip.
        let part = (half_width / way[0].hypot(way[1])).min(1.0);
        let end = [tip[0] - part * way[0], tip[1] - part * way[1]];
        Self {
            ends: [from, end],
            half_width,
        }
    }

    pub(super) fn holds(&self, place: [f64; 2]) -> bool {
        let [from, end] = self.ends;
        let (way, to) = (
            [end[0] - from[0], end[1] - from[1]],
            [place[0] - from[0], place[1] - from[1]],
        );
        let square = way[0] * way[0] + way[1] * way[1];
        let part = match square > 0.0 {
            true => ((way[0] * to[0] + way[1] * to[1]) / square).clamp(0.0, 1.0),
            false => 0.0,
        };
        (to[0] - part * way[0]).hypot(to[1] - part * way[1]) < self.half_width
    }
}
