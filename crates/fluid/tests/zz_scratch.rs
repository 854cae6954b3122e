//! x
#[cfg(test)]
mod common;
use common::*;
use hapflow_fluid::*;
#[test]
fn a() {
    for solver in SOLVERS { for none in [0.05,0.1,0.15,0.25] { for hz in [200.0, 2000.0, 20000.0] {
        let mut c = tank_scene(solver, 0.12, 10, 0.02);
        c.frame_hz=200.0; c.settings.mode=InteractionMode::None;
        let mut run=Run::new(&c); run.run(none);
        c.settings.mode=InteractionMode::Full; run.configure(&c);
        run.config.frame_hz=hz;
        let mut sp=0.0f64; let mut e=0.0f64; let mut first=0.0; let mut deg=0; let mut sub=0;
        for k in 0..(0.2*hz) as usize { let o=run.frame(); sub+=o.substeps; sp=sp.max(o.max_speed); deg+=o.degraded as u32; if k%20==0||hz<300.0{ e=e.max(kinetic_energy(&run.snapshot(), c.settings.particle_mass()));} if k as f64==0.01*hz {first=e;} }
        println!("{solver:?} none {none} hz {hz}: top {sp:.2} KE {e:.3} KE10ms {first:.3} deg {deg} sub {sub} n {}", run.snapshot().ids.len());
    }}}
}
#[test]
fn b() {
    for solver in SOLVERS { for cells in [7,8,10,12,14] {
        let mut c = tank_scene(solver, 0.12, cells, 0.02);
        c.frame_hz=200.0; 
        let mut run=Run::new(&c); 
        let mut sp=0.0f64; let mut e=0.0f64; 
        for _ in 0..80 { let o=run.frame(); sp=sp.max(o.max_speed);  e=e.max(kinetic_energy(&run.snapshot(), c.settings.particle_mass())); }
        println!("fresh tank {solver:?} cells {cells}: top {sp:.2} KE {e:.4} n {}",run.snapshot().ids.len());
    }}
    for solver in SOLVERS { for dx in [0.0035,0.005,0.0075] {
        let mut c = jet_scene(solver, dx); c.world.ground=Some(-0.03); c.frame_hz=200.0;
        let mut run=Run::new(&c); let mut sp=0.0f64;
        for _ in 0..120 { let o=run.frame(); sp=sp.max(o.max_speed);}
        println!("fresh jet {solver:?} {dx}: top {sp:.2} ref {:.2}",c.reference_speed());
    }}
}
