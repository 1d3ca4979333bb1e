//! Choice among the frames of a run whose length is unknown beforehand.

/// Frames at even intervals, at most a number of them: a selection that is full drops every other one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameSelection {
    most: usize,
    stride: u64,
    numbers: Vec<u64>,
}

impl FrameSelection {
    /// An empty selection of at most a number of frames, 2 or more.
    pub fn new(most: usize) -> Self {
        Self::resumed(most, Vec::new())
    }

    /// The selection of frames that are there already.
    pub(crate) fn resumed(most: usize, numbers: Vec<u64>) -> Self {
        let mut stride = 1;
        while numbers.len() > 2
            && numbers
                .iter()
                .all(|number| number.is_multiple_of(2 * stride))
        {
            stride *= 2;
        }
        Self {
            most: most.max(2),
            stride,
            numbers,
        }
    }

    /// Adds a frame, and returns the numbers of those that it drops, which may include its own; `None` for a frame that the stride passes
    /// over, or that repeats the number of the one before. The `last` frame of a run stays.
    pub fn add(&mut self, number: u64, last: bool) -> Option<Vec<u64>> {
        let is_repeated = self.numbers.last() == Some(&number);
        if is_repeated || !(last || number.is_multiple_of(self.stride)) {
            return None;
        }
        self.numbers.push(number);
        if self.numbers.len() <= self.most {
            return Some(Vec::new());
        }
        if last {
            let before = self.numbers.len() - 2;
            return Some(vec![self.numbers.remove(before)]);
        }
        self.stride *= 2;
        let stride = self.stride;
        let (kept, dropped) = std::mem::take(&mut self.numbers)
            .into_iter()
            .partition(|number| number.is_multiple_of(stride));
        self.numbers = kept;
        Some(dropped)
    }

    /// Empties the selection: a run that is repeated with a smaller Courant number starts again.
    pub fn restart(&mut self) {
        self.numbers.clear();
        self.stride = 1;
    }
}
