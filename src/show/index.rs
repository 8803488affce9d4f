//! A page about many curves.

use std::fmt::Write;

use super::svg::escape;

/// Stands in every such page, and in no other.
pub const GENERATOR: &str = "<meta name=\"generator\" content=\"knotproof\">";

const STYLE: &str = include_str!("html/index.css");
const SCRIPT: &str = include_str!("html/index.js");

/// What came of one claim about a curve.
#[derive(Clone, Debug, Default)]
pub struct Cell {
    /// The outcome in one word of letters, such as "certified".
    pub outcome: String,
    /// More about it.
    pub words: String,
    /// Other files about it: what they are called, and where they are.
    pub links: Vec<(&'static str, String)>,
}

/// A curve.
#[derive(Clone, Debug, Default)]
pub struct Row {
    /// Its picture, an element that [`thumbnail`](super::thumbnail) made; empty without one.
    pub thumbnail: String,
    /// The file.
    pub file: String,
    /// Its name in the file.
    pub name: String,
    /// What reading changed.
    pub notes: String,
    /// What came of each claim, in the order of the page's columns; nothing where it was not asked or not finished.
    pub cells: Vec<Option<Cell>>,
}

/// A page.
#[derive(Clone, Debug)]
pub struct Index<'a> {
    /// The heading.
    pub title: &'a str,
    /// A line of numbers below it.
    pub summary: &'a str,
    /// The claims.
    pub columns: &'a [String],
    /// The outcomes that can be chosen.
    pub outcomes: &'a [&'a str],
    /// The curves.
    pub rows: &'a [Row],
}

/// The page, which asks nothing of a network; its links are relative to its folder.
pub fn index(page: &Index) -> String {
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = write(page, &mut text);
    text
}

fn write(page: &Index, text: &mut String) -> std::fmt::Result {
    let title = escape(page.title);
    write!(
        text,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n{GENERATOR}\n\
         <title>{title}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<header><h1>{title}</h1><p>{}</p></header>\n<main>\n",
        escape(page.summary)
    )?;
    text.push_str("<p class=\"tools\"><label>Outcome <select id=\"outcome\"><option value=\"\">all</option>");
    for outcome in page.outcomes {
        write!(text, "<option>{}</option>", escape(outcome))?;
    }
    text.push_str(
        "</select></label> <label>Name <input id=\"name\" type=\"search\"></label> <output id=\"count\"></output></p>\n\
         <table>\n<thead><tr><th></th><th scope=\"col\">curve</th>",
    );
    for column in page.columns {
        write!(text, "<th scope=\"col\">{}</th>", escape(column))?;
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for row in page.rows {
        write_row(row, text)?;
    }
    write!(
        text,
        "</tbody>\n</table>\n</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n"
    )
}

fn write_row(row: &Row, text: &mut String) -> std::fmt::Result {
    let notes = match row.notes.as_str() {
        "" => String::new(),
        notes => format!("<p class=\"notes\">{}</p>", escape(notes)),
    };
    write!(
        text,
        "<tr><td>{}</td><th scope=\"row\">{}<span class=\"file\">{}</span>{notes}</th>",
        row.thumbnail,
        escape(&row.name),
        escape(&row.file)
    )?;
    for cell in &row.cells {
        let Some(cell) = cell else {
            text.push_str("<td></td>");
            continue;
        };
        let outcome = escape(&cell.outcome);
        write!(
            text,
            "<td class=\"{outcome}\"><b>{outcome}</b><p>{}</p>",
            escape(&cell.words)
        )?;
        for (name, place) in &cell.links {
            write!(text, "<a href=\"{}\">{name}</a> ", escape(place))?;
        }
        text.push_str("</td>");
    }
    text.push_str("</tr>\n");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_do_not_become_markup() {
        let cell = Cell {
            outcome: "certified".into(),
            words: "σ < 1 & more".into(),
            links: vec![("certificate", "a\"b.json".into())],
        };
        let rows = [Row {
            thumbnail: "<svg></svg>".into(),
            file: "<script>".into(),
            name: "</td>".into(),
            notes: String::new(),
            cells: vec![Some(cell), None],
        }];
        let columns = ["msd".to_string(), "embedding".to_string()];
        let page = index(&Index {
            title: "a & b",
            summary: "1 curve",
            columns: &columns,
            outcomes: &["certified"],
            rows: &rows,
        });
        for part in [
            "<svg></svg>",
            "&lt;script&gt;",
            "&lt;/td&gt;",
            "σ &lt; 1 &amp; more",
            "a&quot;b.json",
            "<h1>a &amp; b</h1>",
        ] {
            assert!(page.contains(part), "{part} is not in {page}");
        }
        assert_eq!(page.matches("<script>").count(), 1);
        assert!(!page.contains("http"), "no address outside");
    }
}
