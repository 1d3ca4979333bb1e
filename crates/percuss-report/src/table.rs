//! Tables for the terminal, HTML and Markdown.

use percuss::units::significant;

/// A table: columns of the same number of cells.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    /// Its columns.
    pub columns: Vec<Column>,
}

/// A column of a table. Texts are plain: the writers escape them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Column {
    /// Heading; where lines break is for narrow columns in the terminal.
    pub heading: String,
    /// Unit; empty where there is none.
    pub unit: String,
    /// Whether it holds numbers, which are set flush right.
    pub numbers: bool,
    /// Cells from the top.
    pub cells: Vec<String>,
}

impl Table {
    /// An empty table whose cells are read off rows.
    pub fn of<R>(rows: &[R]) -> Rows<'_, R> {
        let table = Self::default();
        Rows { rows, table }
    }

    /// Cells of a row; empty ones where a column is shorter.
    pub fn row(&self, index: usize) -> impl Iterator<Item = &str> {
        let columns = self.columns.iter();
        columns.map(move |column| column.cells.get(index).map_or("", String::as_str))
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        let cells = self.columns.iter().map(|column| column.cells.len());
        cells.max().unwrap_or(0)
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A table under construction, with the rows that its cells are read off.
#[derive(Debug, Clone)]
pub struct Rows<'a, R> {
    rows: &'a [R],
    table: Table,
}

impl<R> Rows<'_, R> {
    /// Adds a column of texts.
    pub fn words<T: Into<String>>(
        self,
        heading: impl Into<String>,
        cell: impl Fn(&R) -> T,
    ) -> Self {
        self.add(heading.into(), String::new(), false, cell)
    }

    /// Adds a column of numbers, with its unit.
    pub fn numbers<T: Into<String>>(
        self,
        heading: impl Into<String>,
        unit: impl Into<String>,
        cell: impl Fn(&R) -> T,
    ) -> Self {
        self.add(heading.into(), unit.into(), true, cell)
    }

    fn add<T: Into<String>>(
        mut self,
        heading: String,
        unit: String,
        numbers: bool,
        cell: impl Fn(&R) -> T,
    ) -> Self {
        self.table.columns.push(Column {
            heading,
            unit,
            numbers,
            cells: self.rows.iter().map(|row| cell(row).into()).collect(),
        });
        self
    }

    /// Adds a cell below the last column, where there is one.
    pub fn last(mut self, cell: Option<String>) -> Self {
        if let Some(column) = self.table.columns.last_mut() {
            column.cells.extend(cell);
        }
        self
    }

    /// Adds what a function adds, if it is wanted.
    pub fn when(self, wanted: bool, add: impl FnOnce(Self) -> Self) -> Self {
        if wanted { add(self) } else { self }
    }

    /// Adds what a function adds for each of several things.
    pub fn each<T>(
        self,
        of: impl IntoIterator<Item = T>,
        add: impl FnMut(Self, T) -> Self,
    ) -> Self {
        of.into_iter().fold(self, add)
    }

    /// The table.
    pub fn table(self) -> Table {
        self.table
    }
}

impl Column {
    /// Heading and unit in one line.
    pub fn title(&self) -> String {
        match self.unit.as_str() {
            "" => self.heading.clone(),
            unit => format!("{} [{unit}]", self.heading),
        }
    }
}

/// A number with so many significant digits; a dash where there is none.
pub fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or_else(|| "\u{2013}".to_owned(), |value| significant(value, digits))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_read_off_rows_and_short_columns_end_empty() {
        let table = Table::of(&[1.5, 2.0])
            .words("name", |value| format!("of {value}"))
            .last(Some("measured".to_owned()))
            .numbers("half\nof it", "mm", |value| number(Some(0.5 * value), 3))
            .when(false, |rows| rows.words("never", |_| ""))
            .each([1, 2], |rows, n| rows.numbers(n.to_string(), "", |_| "–"))
            .table();
        assert_eq!(table.len(), 3);
        assert_eq!(table.columns[1].title(), "half\nof it [mm]");
        let rows: Vec<Vec<&str>> = (0..3).map(|i| table.row(i).collect()).collect();
        assert_eq!(rows[0], ["of 1.5", "0.75", "–", "–"]);
        assert_eq!(rows[2], ["measured", "", "", ""]);
        assert_eq!(number(None, 3), "–");
    }
}
