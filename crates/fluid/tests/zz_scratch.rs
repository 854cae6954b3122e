//! x
#[cfg(test)]
mod common;
use common::*; 
use hapflow_fluid::*;
#[test]
fn a() {
    for solver in SOLVERS { for mode in [InteractionMode::Full, InteractionMode::Mixed] { for cells in [12u32,14] {
        let mut c = tank_scene(solver, 0.2, cells, 0.05); c.settings.mode=mode; 
        let mut run=Run::new(&c); run.run(0.5); let f=run.mean_force(0.5); let mut sd=0.0; 
        for _ in 0..50 { sd+=(run.frame().loads[0].force()-f).length_squared()/50.0; }
        let v=run.snapshot(); let h=v.positions.iter().map(|p|p[1] as f64).sum::<f64>()/v.ids.len() as f64;
        println!("tank {solver:?} {mode:?} {cells} {:.4} sd {:.4} mean height {h:.4} top {:.3}", f/(9810.0*ball_volume(0.05)), sd.sqrt(), top_speed(&v));
    }
        let mut c=jet_scene(solver,0.005); c.settings.mode=mode; c.settings.gravity=glam::DVec3::ZERO;
        c.world.bodies[0].shape=Shape::Disc{radius:0.03,thickness:0.01};
        let mut run=Run::new(&c); run.run(0.3); println!("disc {solver:?} {mode:?} {:.4}", run.mean_force(0.24)/0.70686);
    }}
}
