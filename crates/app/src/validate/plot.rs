//! A picture of a case: error against spacing, one panel a quantity, with its goal.

use crate::draw::chart::{self, Chart, Series};
use crate::draw::error::DrawError;
use crate::run::Failure;
use hapflow_validation::Row;
use std::path::Path;

/// Width of the picture, and height of a panel, pixels.
const WIDTH: u32 = 1200;
const PANEL: u32 = 420;

/// Makes the folder that pictures were asked into, if any were.
pub fn make_folder(folder: Option<&Path>) -> Result<(), Failure> {
    let failed = |folder: &Path, e| Failure::Plot(folder.display().to_string(), e);
    folder.map_or(Ok(()), |folder| std::fs::create_dir_all(folder).map_err(|e| failed(folder, e)))
}

/// Draws the first variant of a case's rows, all spacings.
pub fn save(rows: &[Row], path: &Path) -> Result<(), DrawError> {
    let Some(first) = rows.first() else { return Ok(()) };
    let rows: Vec<_> = rows.iter().filter(|r| r.parameters == first.parameters).collect();
    let mut quantities: Vec<_> = rows.iter().map(|r| r.measure.quantity).collect();
    quantities.sort_unstable();
    quantities.dedup();
    let panel = |quantity: &&str| {
        panel(&rows.iter().filter(|r| r.measure.quantity == *quantity).copied().collect::<Vec<_>>())
    };
    let charts: Vec<_> = quantities.iter().map(panel).collect();
    chart::save(&charts, path, WIDTH, PANEL * charts.len() as u32)
}

/// The panel of one quantity.
fn panel(rows: &[&Row]) -> Chart {
    let mut points: Vec<_> = rows.iter().filter_map(|r| Some([1e3 * r.dx, r.error()?])).collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let m = &rows[0].measure;
    let order = rows[0].order.map_or(String::new(), |order| format!(", order {order:.1}"));
    let mut series = vec![Series::new("error", points.clone()).marked()];
    if let Some(goal) = m.goal {
        let line = points.iter().map(|p| [p[0], goal]).collect::<Vec<_>>();
        series.push(Series::new("goal", line));
    }
    Chart {
        title: format!("{}: {}{order}", rows[0].case, m.quantity),
        x_label: "particle spacing (mm)".into(),
        y_label: "error".into(),
        series,
        log: true,
    }
}
