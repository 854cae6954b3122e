//! Solids, contacts and the force limit from C.
// A test's helpers fail as the test does.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{Api, Contact, JET, Session, ToolState, Variant, Wrench, code};
use std::ptr::null_mut;

/// Behind [`JET`]: a ground under the tool, whose ball has 15 mm, and a second tool that feels nothing of it.
const GROUND: &str = r#"
[[tool]]
solid_stiffness = 400.0
[[tool]]
name = "second"
[[obstacle]]
radius = 0.02
position = [0.0, 0.0, 0.06]
"#;

/// A session whose first tool was led to `place` from above, in 50 ticks; and the last result and wrench.
fn led(api: &Api, place: [f64; 3]) -> (Session, i32, Wrench) {
    let toml = format!("ground = -0.04\n{JET}{GROUND}");
    let session = api.try_create(&toml).unwrap_or_else(|c| panic!("{c}: {}", api.error()));
    let mut last = (code::OK, Wrench::ZERO);
    for n in 0..=50_u64 {
        let share = n as f64 / 50.0;
        let mut state = api.state(n);
        state.position = std::array::from_fn(|k| share * place[k]);
        assert_eq!((api.fluid_advance)(session, state.time_s), code::OK);
        last = api.tick(session, &state);
    }
    (session, last.0, last.1)
}

fn near(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
}

#[test]
fn the_ground_is_felt_and_told_and_the_proxy_stands_on_it() {
    let api = Api::ready(Variant::Shipped);
    let (session, result, _) = led(&api, [0.05, -0.03, 0.0]);
    assert_eq!(result, code::OK);
    let [contact] = api.contacts(session, 0)[..] else { panic!("{:?}", api.contacts(session, 0)) };
    assert_eq!((contact.solid, contact.index), (1, 0));
    assert!(near(&contact.point, &[0.05, -0.04, 0.0]) && contact.normal == [0.0, 1.0, 0.0]);
    assert!(near(&[contact.depth], &[0.005]) && near(&contact.force, &[0.0, 2.0, 0.0]));
    let (position, orientation) = api.proxy(session, 0);
    assert!(near(&position, &[0.05, -0.025, 0.0]) && orientation == [0.0, 0.0, 0.0, 1.0]);
    // The other tool feels no solids: its proxy is its body.
    let other = ToolState { tool: 1, position: [0.0, -0.035, 0.0], ..api.state(0) };
    assert_eq!(api.tick(session, &other).0, code::OK);
    assert_eq!(api.contacts(session, 1), vec![]);
    assert_eq!(api.proxy(session, 1).0, api.report_of(session, 1).body);
}

#[test]
fn an_obstacle_is_told_by_its_number() {
    let api = Api::ready(Variant::Shipped);
    let (session, _, _) = led(&api, [0.0, 0.0, 0.03]);
    let contacts = api.contacts(session, 0);
    assert_eq!((contacts.len(), contacts[0].solid, contacts[0].index), (1, 3, 0));
    assert!(near(&contacts[0].normal, &[0.0, 0.0, -1.0]) && near(&[contacts[0].depth], &[0.005]));
}

#[test]
fn elements_of_other_sizes_are_taken_and_wrong_ones_refused() {
    let api = Api::ready(Variant::Shipped);
    let (session, _, _) = led(&api, [0.05, -0.03, 0.0]);
    let size = size_of::<Contact>() as u32;
    let contact = api.contacts(session, 0)[0];
    // As a program of a later version has them: what it knows more is zero.
    #[repr(C)]
    #[derive(Clone, Copy)]
    struct Grown(Contact, [u64; 2]);
    let (mut grown, mut count) = ([Grown(Contact::default(), [9; 2]); 2], 9);
    let call = |to: *mut Contact, size, capacity, count: *mut usize| {
        (api.session_contacts)(session, 0, to, size, capacity, count)
    };
    assert_eq!(call(grown.as_mut_ptr().cast(), size + 16, 2, &mut count), code::OK);
    assert_eq!((grown[0].0, grown[0].1, grown[1].1, count), (contact, [0; 2], [9; 2], 1));
    let mut untouched = [Contact::default(); 2];
    for wrong in [0, size - 1, 5000, u32::MAX] {
        assert_eq!(call(untouched.as_mut_ptr(), wrong, 2, &mut count), code::STRUCT);
    }
    assert_eq!(call(null_mut(), size, 2, &mut count), code::NULL);
    assert_eq!(call(untouched.as_mut_ptr(), size, 2, null_mut()), code::NULL);
    assert_eq!((api.session_contacts)(session, 2, untouched.as_mut_ptr(), size, 2, &mut count), code::INDEX);
    assert_eq!(api.error(), "no tool 2: there are 2, from 0");
    assert_eq!((untouched, count), ([Contact::default(); 2], 1));
    let (mut position, mut orientation) = ([7.0; 3], [7.0; 4]);
    assert_eq!((api.session_proxy)(session, 0, null_mut(), &mut orientation), code::NULL);
    assert_eq!((api.session_proxy)(session, 0, &mut position, null_mut()), code::NULL);
    assert_eq!((api.session_proxy)(session, 2, &mut position, &mut orientation), code::INDEX);
    assert_eq!((position, orientation), ([7.0; 3], [7.0; 4]));
}

#[test]
fn the_force_limit_falls_and_never_rises() {
    let api = Api::ready(Variant::Shipped);
    let session = api.jet();
    assert_eq!(api.set(session, "tool.force_scale", 1000.0), code::OK);
    let size = |wrench: &Wrench| wrench.force.iter().map(|f| f * f).sum::<f64>().sqrt();
    assert!(size(api.run(session, 0, 100).last().unwrap()) > 3.9);
    assert_eq!((api.session_limit_force)(session, 1.0, 0.05), code::OK);
    assert!(api.run(session, 100, 150).iter().all(|w| size(w) <= 1.0));
    for (force, torque, expected) in [
        (1.5, 0.01, code::VALUE),
        (0.5, 0.06, code::VALUE),
        (-1.0, 0.01, code::VALUE),
        (f64::NAN, 0.01, code::NOT_FINITE),
        (0.5, f64::INFINITY, code::NOT_FINITE),
    ] {
        assert_eq!((api.session_limit_force)(session, force, torque), expected);
    }
    assert_eq!(api.set(session, "gate.max_force", 2.0), code::VALUE);
    assert!(api.error().contains("gate.max_force = 2: must be at most 1 N"), "{}", api.error());
    assert_eq!(
        (api.get(session, "gate.max_force"), api.get(session, "gate.max_torque")),
        (Ok(1.0), Ok(0.05))
    );
    let felt = api.run(session, 150, 200);
    assert!(felt.iter().all(|w| size(w) <= 1.0) && size(felt.last().unwrap()) > 0.99);
    assert_eq!((api.session_limit_force)(session, 0.0, 0.0), code::OK);
    assert_eq!(api.run(session, 200, 201), [Wrench::ZERO]);
    assert_eq!((api.session_limit_force)(Session::default(), 0.0, 0.0), code::HANDLE);
}
