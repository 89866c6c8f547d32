//! What an example prints: CSV with a header, after comments.

/// Rows under named columns.
#[derive(Debug, PartialEq)]
pub(super) struct Table {
    /// The first comment: the machine.
    pub(super) note: String,
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// One row of a table.
#[derive(Clone, Copy)]
pub(super) struct Row<'a> {
    table: &'a Table,
    /// Its line, counted from the header as 1.
    line: usize,
    cells: &'a [String],
}

impl Table {
    /// Reads a table.
    ///
    /// # Errors
    /// Names the row and what is wrong with it.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let note = text.lines().find_map(|line| line.strip_prefix("# ")).unwrap_or_default();
        let mut lines = text.lines().filter(|line| !line.starts_with('#'));
        let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        let columns = cells(lines.next().ok_or("no header, expected names of columns")?);
        let rows: Vec<_> = lines.map(cells).collect();
        match rows.iter().position(|row| row.len() != columns.len()) {
            None => Ok(Self { note: note.to_owned(), columns, rows }),
            Some(row) => Err(format!(
                "row {}: {} cells, expected {}",
                row + 1,
                rows[row].len(),
                columns.len()
            )),
        }
    }

    pub(super) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        (1..).zip(&self.rows).map(|(line, cells)| Row { table: self, line, cells })
    }
}

impl<'a> Row<'a> {
    pub(super) fn text(&self, column: &str) -> Result<&'a str, String> {
        let place = self.table.columns.iter().position(|name| name == column);
        place
            .map(|place| self.cells[place].as_str())
            .ok_or_else(|| format!("no column `{column}`, but {}", self.table.columns.join(", ")))
    }

    pub(super) fn number(&self, column: &str) -> Result<f64, String> {
        let text = self.text(column)?;
        text.parse()
            .map_err(|_| format!("row {}: {column} is `{text}`, expected a number", self.line))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_found_by_their_column() {
        let table = Table::parse("# Some CPU\na,b\n1,x\n2.5e-3,\n").unwrap();
        assert_eq!(table.note, "Some CPU");
        let rows: Vec<_> = table.rows().collect();
        assert_eq!((rows[0].number("a"), rows[0].text("b")), (Ok(1.0), Ok("x")));
        assert_eq!((rows[1].number("a"), rows[1].text("b")), (Ok(2.5e-3), Ok("")));
        assert_eq!(rows[0].number("b"), Err("row 1: b is `x`, expected a number".into()));
        assert_eq!(rows[0].text("c"), Err("no column `c`, but a, b".into()));
    }

    #[test]
    fn a_ragged_table_is_refused() {
        assert_eq!(Table::parse("a,b\n1,2\n3\n"), Err("row 2: 1 cells, expected 2".into()));
        assert!(Table::parse("# only\n").is_err());
    }
}
