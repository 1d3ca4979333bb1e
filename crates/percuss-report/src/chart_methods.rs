//! Methods that charts of all kinds have.

/// Gives charts the method that sets their caption and, where they have marks, the one that adds a mark.
macro_rules! chart_methods {
    ($chart:ty) => {
        impl $chart {
            /// Sets the line below the title.
            pub fn caption(mut self, caption: impl Into<String>) -> Self {
                self.head.caption = caption.into();
                self
            }
        }
    };
    ($chart:ty, marks) => {
        $crate::chart_methods::chart_methods!($chart);
        impl $chart {
            /// Adds a line across the plot.
            pub fn mark(mut self, mark: $crate::Mark) -> Self {
                self.marks.push(mark);
                self
            }
        }
    };
}
pub(crate) use chart_methods;
