//! An illustrated report: one HTML page without scripts, its pictures as PNG files beside it.

use std::{
    fmt::Write,
    path::{Path, PathBuf},
};

use super::{PipelineError, StageTable};
use crate::{data::Map, io};

/// A picture of a figure and the line below it.
#[derive(Debug)]
pub struct Cell {
    /// Linear RGBA, premultiplied.
    pub picture: Map<[f32; 4]>,
    /// What the line below it says; nothing if empty.
    pub note: String,
}

/// Pictures side by side with a common label.
#[derive(Debug)]
pub struct Row {
    /// What stands at the left; nothing if empty.
    pub label: String,
    /// The pictures, all of one size.
    pub cells: Vec<Cell>,
}

/// A table of pictures.
#[derive(Debug)]
pub struct Figure {
    /// Stem of the figure's files.
    pub stem: String,
    /// What stands above it.
    pub title: String,
    /// What it shows.
    pub caption: String,
    /// Headings of the columns.
    pub columns: Vec<String>,
    /// From the top.
    pub rows: Vec<Row>,
}

/// A report being written.
#[derive(Debug)]
pub struct Report<'f> {
    folder: &'f Path,
    html: String,
    figures: usize,
}

/// Pictures up to this width are shown with their pixels visible.
const SMALL: usize = 128;
/// White pixels between the pictures of a sheet.
const GAP: usize = 4;

const HEAD: &str = r#"<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body { max-width: 62rem; margin: 2rem auto 4rem; padding: 0 1rem; font: 1.05rem/1.5 Georgia, "Times New Roman", serif; color: #222; background: #fff; }
h1, h2 { line-height: 1.2; font-weight: normal; }
h2 { margin: 2.5rem 0 0.5rem; }
figure { margin: 0; overflow-x: auto; }
figcaption, td, th { font: 0.85rem/1.4 system-ui, sans-serif; }
figcaption { max-width: 46rem; margin-top: 0.5rem; color: #444; }
table { border-collapse: collapse; }
th { font-weight: normal; color: #444; }
.pictures { width: 100%; table-layout: fixed; }
.pictures td, .pictures th { padding: 0.2rem; text-align: center; vertical-align: top; }
.pictures .label { width: 7rem; padding-right: 0.6rem; overflow-wrap: break-word; text-align: left; vertical-align: middle; }
.pictures img { width: 100%; height: auto; display: block; }
img.small { image-rendering: pixelated; }
.drawing { width: 100%; height: auto; display: block; }
.numbers td, .numbers th { padding: 0.15rem 1rem 0.15rem 0; text-align: right; white-space: nowrap; }
.numbers thead th { border-bottom: 1px solid #999; }
.stages td:first-child, .stages th:first-child, .stages td:last-child, .stages th:last-child { text-align: left; }
</style>
"#;

impl<'f> Report<'f> {
    /// Begins a report in `folder`, which must exist.
    pub fn new(folder: &'f Path, title: &str, introduction: &str) -> Self {
        let (title, introduction) = (escape(title), escape(introduction));
        let html = format!("{HEAD}<title>{title}</title>\n</head>\n<body>\n<h1>{title}</h1>\n<p>{introduction}</p>\n");
        Self { folder, html, figures: 0 }
    }

    /// Adds a figure: its pictures one by one for the page, and together on one sheet.
    ///
    /// # Errors
    /// [`PipelineError`] if a picture cannot be written.
    pub fn figure(&mut self, figure: &Figure) -> Result<(), PipelineError> {
        self.figures += 1;
        let Figure { stem, title, caption, columns, rows } = figure;
        let labelled = rows.iter().any(|row| !row.label.is_empty());
        let mut table = String::from("<table class=\"pictures\">\n<thead><tr>");
        if labelled {
            table.push_str("<th class=\"label\"></th>");
        }
        for column in columns {
            table.push_str(&format!("<th>{}</th>", escape(column)));
        }
        table.push_str("</tr></thead>\n");
        for (row_number, row) in rows.iter().enumerate() {
            table.push_str("<tr>");
            if labelled {
                table.push_str(&format!("<th class=\"label\">{}</th>", escape(&row.label).replace('/', "/<wbr>")));
            }
            for (column, cell) in row.cells.iter().enumerate() {
                let file = format!("{stem}_{row_number}_{column}.png");
                io::picture::write(&self.folder.join(&file), &cell.picture)?;
                let alt = [row.label.as_str(), columns.get(column).map_or("", String::as_str)].join(" ");
                let class = if cell.picture.width() <= SMALL { " class=\"small\"" } else { "" };
                let (width, height) = (cell.picture.width(), cell.picture.height());
                let image = format!("<img{class} src=\"{file}\" width=\"{width}\" height=\"{height}\" alt=\"{}\">", escape(alt.trim()));
                table.push_str(&format!("<td>{image}{}</td>", escape(&cell.note)));
            }
            table.push_str("</tr>\n");
        }
        table.push_str("</table>\n");
        io::picture::write(&self.folder.join(format!("{stem}.png")), &sheet(rows))?;
        let (number, title, caption) = (self.figures, escape(title), escape(caption));
        let sheet = format!("<a href=\"{stem}.png\">All in one picture.</a>");
        self.html +=
            &format!("<h2>{title}</h2>\n<figure>\n{table}<figcaption>Figure {number}. {caption} {sheet}</figcaption>\n</figure>\n");
        Ok(())
    }

    /// Adds a drawing, as the SVG file `stem`.svg beside the page.
    ///
    /// # Errors
    /// [`PipelineError`] if it cannot be written.
    pub fn drawing(&mut self, stem: &str, title: &str, caption: &str, svg: &str) -> Result<(), PipelineError> {
        io::write(&self.folder.join(format!("{stem}.svg")), svg.as_bytes())?;
        self.figures += 1;
        let (number, title, caption) = (self.figures, escape(title), escape(caption));
        let image = format!("<img class=\"drawing\" src=\"{stem}.svg\" alt=\"{title}\">");
        self.html += &format!("<h2>{title}</h2>\n<figure>\n{image}\n<figcaption>Figure {number}. {caption}</figcaption>\n</figure>\n");
        Ok(())
    }

    /// Adds a table of numbers; `caption` may be empty.
    pub fn table(&mut self, title: &str, caption: &str, header: &[String], rows: &[Vec<String>]) {
        let cells = |tag: &str, cells: &[String]| cells.iter().map(|cell| format!("<{tag}>{}</{tag}>", escape(cell))).collect::<String>();
        let body: String = rows.iter().map(|row| format!("<tr>{}</tr>\n", cells("td", row))).collect();
        let (title, caption, header) = (escape(title), escape(caption), cells("th", header));
        self.html += &format!(
            "<h2>{title}</h2>\n<figure>\n<table class=\"numbers\">\n<thead><tr>{header}</tr></thead>\n{body}</table>\n\
             <figcaption>{caption}</figcaption>\n</figure>\n"
        );
    }

    /// Adds the table of stages and writes the page as `name`; returns its path.
    ///
    /// # Errors
    /// [`PipelineError`] if it cannot be written.
    pub fn finish(mut self, name: &str, stages: &StageTable) -> Result<PathBuf, PipelineError> {
        self.stages(stages);
        self.html.push_str("</body>\n</html>\n");
        let path = self.folder.join(name);
        io::write(&path, self.html.as_bytes())?;
        Ok(path)
    }

    fn stages(&mut self, stages: &StageTable) {
        let named = stages.adapter.as_ref().map_or_else(
            || "none".to_owned(),
            |adapter| escape(&format!("{} ({}, {}, {})", adapter.name, adapter.kind, adapter.backend, adapter.driver)),
        );
        let html = &mut self.html;
        html.push_str(
            "<h2>Stages</h2>\n<figure>\n<table class=\"numbers stages\">\n<thead><tr><th>stage</th><th>wall s</th><th>share</th><th>adapter s</th>",
        );
        html.push_str("<th>texels</th><th>samples</th><th>ran on</th></tr></thead>\n");
        for stage in &stages.stages {
            let gpu = stage.gpu_seconds.map_or_else(|| "–".to_owned(), |seconds| format!("{seconds:.3}"));
            // Writing into a string cannot fail.
            writeln!(
                html,
                "<tr><td>{}</td><td>{:.3}</td><td>{:.1} %</td><td>{gpu}</td><td>{}</td><td>{}</td><td>{}</td></tr>",
                escape(&stage.name),
                stage.wall_seconds,
                100.0 * stages.share(stage),
                stage.texels,
                stage.samples,
                escape(stages.place(stage)),
            )
            .ok();
        }
        html.push_str(&format!(
            "</table>\n<figcaption>Adapter: {named}. Wall time includes transfers and waiting; adapter time is that of the passes alone, where the \
             adapter can tell. Texels are summed over tiles; samples are those of each texel. The whole job took {:.1} s up to here.</figcaption>\n</figure>\n",
            stages.wall_seconds
        ));
    }
}

/// All pictures of a figure on one white sheet, `rows` from the top; pictures of a row side by side.
fn sheet(rows: &[Row]) -> Map<[f32; 4]> {
    let size = |cell: &Cell| (cell.picture.width(), cell.picture.height());
    let cells = || rows.iter().flat_map(|row| &row.cells).map(size);
    // Every picture has a place of the size of the largest.
    let (width, height) = cells().fold((1, 1), |(width, height), (w, h)| (width.max(w), height.max(h)));
    let columns = rows.iter().map(|row| row.cells.len()).max().unwrap_or(0).max(1);
    let (sheet_width, sheet_height) = (columns * (width + GAP) - GAP, rows.len().max(1) * (height + GAP) - GAP);
    Map::from_fn(sheet_width, sheet_height, |x, y| {
        let (column, row) = (x / (width + GAP), y / (height + GAP));
        let (x, y) = (x % (width + GAP), y % (height + GAP));
        let cell = rows.get(row).and_then(|row| row.cells.get(column)).filter(|cell| x < size(cell).0 && y < size(cell).1);
        cell.map_or([1.0; 4], |cell| {
            let [red, green, blue, alpha] = cell.picture[(x, y)];
            [red + 1.0 - alpha, green + 1.0 - alpha, blue + 1.0 - alpha, 1.0]
        })
    })
}

/// Text as it stands in HTML, in an attribute too.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
