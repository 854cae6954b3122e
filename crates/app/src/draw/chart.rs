//! Line charts, stacked above one x axis.

use std::path::Path;

use super::axis::Axis;
use super::error::DrawError;
use super::font::Pen;
use super::image::{Image, save_png};
use super::stroke::{Stroke, fill};

/// Colours that colour-blind eyes tell apart, after Okabe and Ito.
const PALETTE: [[u8; 3]; 6] =
    [[0, 114, 178], [213, 94, 0], [0, 145, 105], [176, 74, 134], [200, 130, 0], [70, 160, 210]];
const PAPER: [u8; 3] = [247, 249, 251];
const PANEL: [u8; 3] = [255, 255, 255];
const GRID: [u8; 3] = [222, 228, 233];
const ZERO: [u8; 3] = [150, 160, 170];
const INK: [u8; 3] = [34, 46, 58];
const SOFT_INK: [u8; 3] = [92, 106, 120];

/// A curve.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub label: String,
    /// Its points, x and y; one that is not finite makes a gap.
    pub points: Vec<[f64; 2]>,
    /// Its colour; none for the next of the palette.
    pub colour: Option<[u8; 3]>,
    /// Whether it is drawn thin and pale, behind the others.
    pub faint: bool,
    /// Whether its points are marked.
    pub marked: bool,
}

impl Series {
    /// A curve named `label`, in a colour of the palette.
    pub fn new(label: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self { label: label.into(), points, colour: None, faint: false, marked: false }
    }

    /// The same curve in `colour`.
    pub fn coloured(self, colour: [u8; 3]) -> Self {
        Self { colour: Some(colour), ..self }
    }

    /// The same curve with its points marked.
    pub fn marked(self) -> Self {
        Self { marked: true, ..self }
    }

    /// The same curve, thin and pale behind the others.
    pub fn faint(self) -> Self {
        Self { faint: true, ..self }
    }
}

/// One panel of curves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Chart {
    /// What it shows.
    pub title: String,
    /// What x is, with its unit; written below the lowest panel.
    pub x_label: String,
    /// What y is, with its unit.
    pub y_label: String,
    /// Its curves, later ones in front.
    pub series: Vec<Series>,
    /// Whether both scales are logarithmic; what is not above 0 makes a gap. All panels of a picture alike.
    pub log: bool,
}

impl Chart {
    /// Where a point lies on the scales.
    fn place(&self, point: &[f64; 2]) -> [f64; 2] {
        if self.log { point.map(f64::log10) } else { *point }
    }

    /// All points on the scales.
    fn places(&self) -> impl Iterator<Item = [f64; 2]> {
        self.series.iter().flat_map(|series| &series.points).map(|p| self.place(p))
    }
}

/// Draws `charts` one below the other and writes them as a PNG file of `width` by `height` pixels.
pub fn save(charts: &[Chart], path: &Path, width: u32, height: u32) -> Result<(), DrawError> {
    save_png(&draw(charts, width, height)?, path)
}

/// Draws `charts` one below the other, with one x axis.
pub fn draw(charts: &[Chart], width: u32, height: u32) -> Result<Image, DrawError> {
    let mut image = Image::filled(width.min(16_384), height.min(16_384), PAPER);
    let sheet = Sheet::new(charts, &image)?;
    for (place, chart) in charts.iter().enumerate() {
        let panel = Panel::new(&sheet, chart, place, charts.len());
        panel.draw(&mut image, place + 1 == charts.len());
    }
    Ok(image)
}

/// What all panels share.
struct Sheet {
    pen: Pen,
    bold: Pen,
    /// Size of the letters, pixels.
    size: f32,
    x: Axis,
    /// Edges of the panels: left, top of the first, right, bottom of the last.
    edges: [f32; 4],
}

impl Sheet {
    fn new(charts: &[Chart], image: &Image) -> Result<Self, DrawError> {
        let (width, height) = (image.width as f32, image.height as f32);
        let size = (width.min(1.5 * height) / 68.0).clamp(7.0, 60.0);
        let bad_font = || DrawError::Chart("the lettering cannot be read".into());
        let pen = Pen::new(size).ok_or_else(bad_font)?;
        let bold = Pen::new(1.18 * size).ok_or_else(bad_font)?;
        let xs = charts.iter().flat_map(Chart::places).map(|p| p[0]);
        let log = charts.iter().any(|chart| chart.log);
        let room = if log { 0.04 } else { 0.0 };
        let x = Axis::holding(xs, room, (width / (6.5 * size)).clamp(2.0, 12.0).into()).logarithmic(log);
        let edges = [5.6 * size, 0.6 * size, width - 1.6 * size, height - 3.6 * size];
        Ok(Self { pen, bold, size, x, edges })
    }
}

/// One panel on the sheet.
struct Panel<'a> {
    sheet: &'a Sheet,
    chart: &'a Chart,
    y: Axis,
    /// Left, top, right and bottom of the field of curves, whole pixels.
    field: [f32; 4],
}

impl<'a> Panel<'a> {
    fn new(sheet: &'a Sheet, chart: &'a Chart, place: usize, count: usize) -> Self {
        let [left, top, right, bottom] = sheet.edges;
        let share = (bottom - top) / count as f32;
        let head = 2.6 * sheet.size;
        let top = top + share * place as f32;
        let field =
            [left, top + head, right.max(left + 2.0), (top + share).max(top + head + 2.0)].map(f32::round);
        let ys = chart.places().map(|p| p[1]);
        let count = ((field[3] - field[1]) / (2.6 * sheet.size)).clamp(2.0, 8.0);
        let y = Axis::holding(ys, 0.06, count.into()).logarithmic(chart.log);
        Self { sheet, chart, y, field }
    }

    fn draw(&self, image: &mut Image, last: bool) {
        fill(image, self.field, PANEL, 1.0);
        self.grid(image, last);
        self.head(image);
        for faint in [true, false] {
            for (series, colour) in self.curves().filter(|(series, _)| series.faint == faint) {
                self.curve(image, series, colour);
            }
        }
    }

    /// Every curve with its colour.
    fn curves(&self) -> impl Iterator<Item = (&'a Series, [u8; 3])> {
        let mut next = PALETTE.into_iter().cycle();
        self.chart.series.iter().map(move |series| {
            let colour = series.colour.or_else(|| next.next()).unwrap_or(INK);
            (series, colour)
        })
    }

    fn across(&self, x: f64) -> f32 {
        self.field[0] + (self.field[2] - self.field[0]) * self.sheet.x.share(x) as f32
    }

    fn up(&self, y: f64) -> f32 {
        self.field[3] - (self.field[3] - self.field[1]) * self.y.share(y) as f32
    }

    fn grid(&self, image: &mut Image, last: bool) {
        let (pen, size) = (&self.sheet.pen, self.sheet.size);
        let [left, top, right, bottom] = self.field;
        let thin = (size / 14.0).max(1.0).round();
        for tick in self.y.ticks() {
            let y = self.up(tick).round();
            let zero = !self.y.log && tick.abs() < 1e-6 * self.y.step;
            let colour = if zero { ZERO } else { GRID };
            fill(image, [left, y, right, y + thin], colour, 1.0);
            let text = self.y.text(tick);
            pen.write(image, left - 0.5 * size - pen.width(&text), y + 0.36 * size, &text, SOFT_INK);
        }
        for tick in self.sheet.x.ticks() {
            let x = self.across(tick).round();
            fill(image, [x, top, x + thin, bottom], GRID, 1.0);
            if last {
                let text = self.sheet.x.text(tick);
                let x = (x - 0.5 * pen.width(&text)).min(image.width as f32 - pen.width(&text) - 2.0);
                pen.write(image, x, bottom + 1.3 * size, &text, SOFT_INK);
            }
        }
        self.names(image, last);
    }

    /// The names of the axes.
    fn names(&self, image: &mut Image, last: bool) {
        let (pen, size) = (&self.sheet.pen, self.sheet.size);
        let [left, top, right, bottom] = self.field;
        let name = &self.chart.y_label;
        pen.write_up(image, 1.5 * size, 0.5 * (top + bottom + pen.width(name)), name, INK);
        if last {
            let name = &self.chart.x_label;
            pen.write(image, 0.5 * (left + right - pen.width(name)), bottom + 2.8 * size, name, INK);
        }
    }

    /// The title on the left and the legend on the right.
    fn head(&self, image: &mut Image) {
        let (pen, size) = (&self.sheet.pen, self.sheet.size);
        let [left, top, right, _] = self.field;
        let base = top - 0.8 * size;
        self.sheet.bold.write(image, left, base, &self.chart.title, INK);
        let mut x = right;
        let curves: Vec<_> = self.curves().filter(|(series, _)| !series.label.is_empty()).collect();
        for (series, colour) in curves.into_iter().rev() {
            x -= pen.width(&series.label);
            pen.write(image, x, base, &series.label, SOFT_INK);
            x -= 2.0 * size;
            let y = base - 0.36 * size;
            let thick = self.thick(series).max(0.16 * size);
            fill(image, [x, y - 0.5 * thick, x + 1.6 * size, y + 0.5 * thick], colour, shade(series));
            x -= 1.2 * size;
        }
    }

    fn thick(&self, series: &Series) -> f32 {
        let share = if series.faint { 0.075 } else { 0.125 };
        (share * self.sheet.size).max(1.0)
    }

    fn curve(&self, image: &mut Image, series: &Series, colour: [u8; 3]) {
        let [left, top, right, bottom] = self.field;
        let mut stroke =
            Stroke::new(left as i64, top as i64, (right - left) as usize, (bottom - top) as usize);
        let points = series.points.iter().map(|p| self.chart.place(p));
        let places: Vec<_> = points.map(|p| [self.across(p[0]), self.up(p[1])]).collect();
        stroke.line(places.iter().copied(), self.thick(series));
        for &place in places.iter().filter(|_| series.marked) {
            stroke.line(std::iter::once(place), 0.7 * self.sheet.size);
        }
        stroke.ink(image, colour, shade(series));
    }
}

/// How strongly a curve is drawn.
fn shade(series: &Series) -> f32 {
    if series.faint { 0.38 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chart(points: Vec<[f64; 2]>) -> Chart {
        Chart { title: "force".into(), series: vec![Series::new("y", points)], ..Chart::default() }
    }

    #[test]
    fn odd_charts_are_drawn() {
        for points in [vec![], vec![[0.0, f64::NAN]], vec![[1.0, 1.0]], vec![[0.0, 1e300], [1.0, -1e300]]] {
            for (width, height) in [(0, 0), (40, 900), (640, 360)] {
                for log in [false, true] {
                    let charts = [Chart { log, ..chart(points.clone()) }, Chart { log, ..chart(vec![]) }];
                    let image = draw(&charts, width, height).unwrap();
                    assert_eq!(image.pixels.len(), (image.width * image.height) as usize);
                }
            }
        }
        assert_eq!(draw(&[], 64, 64).unwrap().width, 64);
    }

    #[test]
    fn a_curve_leaves_its_colour() {
        let line = chart((0..100).map(|i| [f64::from(i), f64::from(i)]).collect());
        let image = draw(&[line], 640, 360).unwrap();
        assert!(image.pixels.contains(&PALETTE[0]));
    }
}
