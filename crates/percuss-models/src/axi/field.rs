//! Nodes of one body: masses, momenta and forces come in from particles, velocities go back.

use super::{body::Chunk, kernel::Stencil};

/// What particles add to a node: mass [kg], momentum radial and axial [kg m/s], volume [m3], force radial and axial [N].
///
/// Filled up to a line of the cache, which one instruction loads.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[repr(align(64))]
pub(super) struct Node(pub(super) [f64; 8]);

impl std::ops::Deref for Node {
    type Target = [f64; 8];

    fn deref(&self) -> &[f64; 8] {
        &self.0
    }
}

impl std::ops::DerefMut for Node {
    fn deref_mut(&mut self) -> &mut [f64; 8] {
        &mut self.0
    }
}

pub(super) const MASS: usize = 0;
pub(super) const MOMENTUM: usize = 1;
pub(super) const VOLUME: usize = 3;
pub(super) const FORCE: usize = 4;

/// Rows of nodes that particles of one chunk reach. Column 0 is the mirror image of column 2 in the axis, which is column 1.
#[derive(Debug, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Strip {
    pub(super) first_row: isize,
    pub(super) rows: usize,
    pub(super) columns: usize,
    /// Every step fills them again, so a checkpoint goes without.
    #[serde(skip)]
    pub(super) nodes: Vec<Node>,
}

impl Strip {
    /// Clears the strip for a range of rows.
    pub(super) fn open(&mut self, first_row: isize, rows: usize, columns: usize) {
        self.first_row = first_row;
        self.rows = rows;
        self.columns = columns;
        self.nodes.clear();
        self.nodes.resize(rows * columns, Node::default());
    }

    /// Nodes of a row, if the strip has it.
    pub(super) fn row(&self, row: isize) -> Option<&[Node]> {
        let index = usize::try_from(row - self.first_row).ok()?;
        (index < self.rows).then(|| &self.nodes[index * self.columns..(index + 1) * self.columns])
    }
}

/// Nodes of a body after the particles of all its chunks have been added up.
#[derive(Debug, Default, serde::Serialize, serde::Deserialize)]
pub(super) struct Field {
    pub(super) first_row: isize,
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) nodes: Vec<Node>,
    /// Velocity after the step, radial and axial, and before it as it came from the particles [m/s].
    pub(super) velocity: Vec<[f64; 4]>,
    /// What contact takes from a node in this step [N s].
    #[serde(skip)]
    pub(super) impulse: Vec<[f64; 2]>,
}

impl Field {
    /// Makes the window as large as the strips of all chunks.
    pub(super) fn cover(&mut self, chunks: &[Chunk]) {
        let strips = chunks.iter().map(|chunk| &chunk.strip);
        let strips = strips.filter(|strip| strip.rows > 0);
        let first = strips.clone().map(|strip| strip.first_row).min();
        let last = strips.clone().map(|s| s.first_row + s.rows as isize).max();
        let (first, last) = (first.unwrap_or(0), last.unwrap_or(0));
        self.first_row = first;
        self.rows = (last - first) as usize;
        self.columns = strips.map(|strip| strip.columns).max().unwrap_or(0);
        self.nodes.resize(self.rows * self.columns, Node::default());
        self.velocity.resize(self.rows * self.columns, [0.0; 4]);
        self.impulse.clear();
        self.impulse.resize(self.rows * self.columns, [0.0; 2]);
    }

    /// Index of a node: its column is counted with the mirrored one, its row from the struck face.
    pub(super) fn index(&self, row: isize, column: usize) -> Option<usize> {
        let row = usize::try_from(row - self.first_row).ok()?;
        (row < self.rows && column < self.columns).then(|| row * self.columns + column)
    }

    /// Whether the window has all nodes of a stencil.
    pub(super) fn has(&self, [radial, axial]: &[Stencil; 2]) -> bool {
        let column = |first: isize| usize::try_from(first + 1).ok();
        let corner = |row: isize, first: isize| {
            column(first).is_some_and(|column| self.index(row, column).is_some())
        };
        corner(axial.first, radial.first) && corner(axial.first + 2, radial.first + 2)
    }

    /// What contact takes from the node in this step [N s].
    pub(super) fn taken(&self, row: isize, column: usize) -> [f64; 2] {
        self.index(row, column)
            .map_or([0.0; 2], |index| self.impulse[index])
    }

    /// The node, or an empty one outside the window.
    pub(super) fn node(&self, row: isize, column: usize) -> Node {
        self.index(row, column)
            .map_or(Node::default(), |index| self.nodes[index])
    }
}
