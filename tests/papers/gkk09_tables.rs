//! GKK09, Tables 1 to 3: counts, and what the columns say of each other.

use knotproof::claim::domain::Sign;
use knotproof::number::{Rational, decimal_down, decimal_up};

use crate::exact::{file, number, whole};
use crate::gkk09::{levels, question};
use crate::table::{Exact, Page, Row, Verdict, rounded_from, row, unknown};

/// A column that is printed: its level, absolute and relative error ("" for –), inequalities, vertices or faces.
struct Column {
    level: usize,
    absolute: &'static str,
    relative: &'static str,
    inequalities: usize,
    corners: usize,
}

const fn column(
    level: usize,
    absolute: &'static str,
    relative: &'static str,
    inequalities: usize,
    corners: usize,
) -> Column {
    Column {
        level,
        absolute,
        relative,
        inequalities,
        corners,
    }
}

struct Table {
    name: &'static str,
    columns: [Column; 5],
    times: &'static str,
    measure: &'static str,
    corners: &'static str,
    /// Sides of the box.
    sides: usize,
    /// The measure of the box, where it is printed.
    whole: Option<i64>,
    what: &'static str,
}

const TABLES: [Table; 3] = [
    Table {
        name: "Table 1",
        columns: [
            column(0, "", "", 4, 5),
            column(1, "2.8657", "0.34948e-1", 8, 6),
            column(2, "0.29590", "0.34866e-2", 16, 7),
            column(3, "0.11557", "0.13571e-2", 32, 9),
            column(5, "0.63280e-2", "0.74175e-4", 128, 23),
        ],
        times: "0.015 s, …, 0.046 s",
        measure: "area",
        corners: "vertices",
        sides: 4,
        whole: Some(400),
        what: "a planar cubic, (2n − 2)·2^ℓ",
    },
    Table {
        name: "Table 2",
        columns: [
            column(1, "", "", 16, 6),
            column(2, "1406.8", "7.1681", 32, 4),
            column(3, "145.33", "0.90659e-1", 64, 4),
            column(5, "24.836", "0.13803e-1", 256, 3),
            column(7, "1.3061", "0.71275e-3", 1024, 3),
        ],
        times: "0.015 s, …, 2.839 s",
        measure: "area",
        corners: "vertices",
        sides: 4,
        whole: None,
        what: "a planar quintic, (2n − 2)·2^ℓ",
    },
    Table {
        name: "Table 3",
        columns: [
            column(0, "", "", 10, 10),
            column(2, "27837.0", "0.16838e-1", 40, 17),
            column(3, "3378.8", "0.20099e-2", 80, 28),
            column(4, "1029.7", "0.61131e-3", 160, 49),
            column(5, "244.36", "0.14498e-3", 320, 92),
        ],
        times: "0.015 s, …, 5.054 s",
        measure: "volume",
        corners: "faces",
        sides: 6,
        whole: Some(8_000_000),
        what: "a spatial quintic, (3n − 5)·2^ℓ",
    },
];

pub fn write(page: &mut Page) {
    for (i, table) in TABLES.iter().enumerate() {
        page.heading(3, &format!("§4, {}", table.name));
        page.table(table.rows(i));
        page.text(&table.first());
    }
    page.text(TIMES);
}

const TIMES: &str = "\
Errors are printed to five digits, so the measures that follow from them are intervals. Counts depend on the degree alone and are those of curves of the corpus; how long the levels take here: [BENCHMARKS.md](BENCHMARKS.md).";

type Interval = [Rational; 2];

fn shown([low, high]: &Interval) -> String {
    format!("[{}, {}]", decimal_down(low, 6), decimal_up(high, 6))
}

impl Column {
    /// The measure of the level before: absolute over relative error.
    fn before(&self) -> Interval {
        let ([a, b], [c, d]) = (rounded_from(self.absolute), rounded_from(self.relative));
        [a / d, b / c]
    }

    /// The measure of this level.
    fn own(&self) -> Interval {
        let ([a, b], [low, high]) = (rounded_from(self.absolute), self.before());
        [low + a, high + b]
    }
}

impl Table {
    fn rows(&self, number_of_table: usize) -> Vec<Row> {
        let mut rows = self.counts(number_of_table);
        rows.extend(self.measures());
        let filled = &self.columns[1..];
        let falls = filled
            .windows(2)
            .all(|pair| number(pair[1].relative) < number(pair[0].relative));
        rows.push(row(
            "relative errors",
            "fall from column to column",
            &format!("{} to {}", filled[0].relative, filled[3].relative),
            Verdict::holds(falls),
        ));
        let corners: Vec<String> = self.columns.iter().map(|column| column.corners.to_string()).collect();
        rows.push(unknown(
            &format!("# {}", self.corners),
            &corners.join(", "),
            "the control points are not printed",
        ));
        let most = self
            .columns
            .iter()
            .all(|column| column.corners <= column.inequalities + self.sides);
        rows.push(row(
            "",
            &format!("# {} ≤ # inequalities + sides of the box", self.corners),
            &format!("{} sides", self.sides),
            Verdict::holds(most),
        ));
        if let Some(measure) = self.whole {
            let last = self.columns[4].own();
            rows.push(row(
                &format!("{} of the box", self.measure),
                &format!("K^(5) ⊂ 𝓑, {}", Exact::from(whole(measure))),
                &shown(&last),
                Verdict::holds(last[1] <= whole(measure)),
            ));
        }
        match number_of_table {
            0 => rows.push(row("row names", "CPI time", "CPU time (misprint)", Verdict::misprint())),
            1 => rows.push(unknown(
                "Figure 3",
                "K_κ is a triangle",
                "the control points are not printed; 3 vertices at levels 5 and 7 agree with it",
            )),
            _ => rows.push(row(
                "caption",
                "the box \"is centered at d = (0, 0)\"",
                "three coordinates in space (misprint)",
                Verdict::misprint(),
            )),
        }
        rows.push(unknown("CPU time", self.times, "times of a laptop of 2009"));
        rows
    }

    /// The measure before the second column, which no column shows.
    fn first(&self) -> String {
        let second = &self.columns[1];
        format!(
            "Not printed, but it follows: the {} at ℓ = {} is {}/{}, in {}.",
            self.measure,
            second.level - 1,
            second.absolute,
            second.relative,
            shown(&second.before())
        )
    }

    fn counts(&self, number_of_table: usize) -> Vec<Row> {
        let last = self.columns[4].level as u32;
        let counts: Vec<usize> = match number_of_table {
            0 => levels::<2>(&file("domain-cubic"), &question(1, None, 20), last),
            1 => levels::<2>(
                &file("domain-quintic-bounded"),
                &question(2, Some(Sign::Positive), 400),
                last,
            ),
            _ => levels::<3>(&file("domain-quintic-spatial"), &question(2, None, 200), last),
        }
        .iter()
        .map(|level| level.inequalities)
        .collect();
        let line = |(i, column): (usize, &Column)| {
            row(
                &if i == 0 {
                    format!("# inequalities, order ℓ = {}", column.level)
                } else {
                    format!("ℓ = {}", column.level)
                },
                &column.inequalities.to_string(),
                &if i == 0 {
                    format!("{} ({})", counts[column.level], self.what)
                } else {
                    counts[column.level].to_string()
                },
                Verdict::equal(column.inequalities == counts[column.level]),
            )
        };
        self.columns.iter().enumerate().map(line).collect()
    }

    /// From errors to measures, and between the columns.
    fn measures(&self) -> Vec<Row> {
        let mut rows = Vec::new();
        for column in &self.columns[1..] {
            rows.push(unknown(
                &format!("ℓ = {}", column.level),
                &format!("abs. error {}, rel. error {}", column.absolute, column.relative),
                "the control points are not printed",
            ));
        }
        for pair in self.columns[1..].windows(2) {
            let (first, second) = (&pair[0], &pair[1]);
            let (own, before) = (first.own(), second.before());
            let next = second.level == first.level + 1;
            let consistent = if next {
                own[0] <= before[1] && before[0] <= own[1]
            } else {
                own[0] < before[1]
            };
            rows.push(row(
                &match next {
                    true => format!("{} at ℓ = {}, twice", self.measure, first.level),
                    false => format!(
                        "{} at ℓ = {} and at ℓ = {}",
                        self.measure,
                        first.level,
                        second.level - 1
                    ),
                },
                &format!(
                    "{0}/{1} + {0} {2} {3}/{4}",
                    first.absolute,
                    first.relative,
                    if next { "=" } else { "<" },
                    second.absolute,
                    second.relative
                ),
                &format!("{} and {}", shown(&own), shown(&before)),
                Verdict::holds(consistent),
            ));
        }
        rows
    }
}
