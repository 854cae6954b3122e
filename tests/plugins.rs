//! Plugins bring a fluid, a device or a coupling; a broken one is refused, and one that fails while it runs is not felt.
#![allow(clippy::unwrap_used, clippy::panic)]

mod c_support;

use c_support::{JET, compile, root, scratch};
use glam::DVec3;
use hapflow::devices::HapticDevice;
use hapflow::engine::run::{Outcome, RunOptions, virtual_clock};
use hapflow::engine::{Parts, Scene, SceneError, Value, parse, settings};
use hapflow::haptics::{FaultSet, GatedWrench};
use hapflow_host::{Extensions, PluginCoupling, PluginFluid, find};
use std::ffi::OsStr;
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

/// A shared library of one source.
fn built(source: &Path, name: &str) -> PathBuf {
    let made = scratch().join(format!("lib{name}.so"));
    let flags = ["-shared", "-fPIC", "-O2", "-o"].map(OsStr::new);
    let files = [made.as_os_str(), source.as_os_str(), OsStr::new("-lm")];
    let cpp = source.extension().is_some_and(|e| e == "cpp");
    let (compiler, standard) = if cpp { ("c++", "c++17") } else { ("cc", "c11") };
    compile(compiler, standard, &[&flags[..], &files].concat()).unwrap_or_else(|e| panic!("{e}"));
    made
}

/// The fluid of the examples: built once, for several tests load it.
fn jet_fluid() -> &'static Path {
    static BUILT: OnceLock<PathBuf> = OnceLock::new();
    BUILT.get_or_init(|| built(&root().join("examples/plugins/jet_fluid.c"), "jet_fluid"))
}

/// A library of a few lines of C.
fn written(name: &str, text: &str) -> PathBuf {
    let source = scratch().join(format!("plugin-{name}.c"));
    fs::write(
        &source,
        format!("#include <hapflow/hapflow.h>\n#include <math.h>\n#include <string.h>\n{text}\n"),
    )
    .unwrap();
    built(&source, &format!("plugin-{name}"))
}

/// Why a plugin is refused.
fn refused(file: &Path) -> String {
    Extensions::load(file).err().unwrap().to_string()
}

fn scene(words: &[(&str, &str)]) -> Scene {
    let hand = "[hand]\nscript = [{ swing = [0.004, 0.006, 0.0], hz = 3.0, for = 1.0 }]\n";
    let mut scene = parse(&format!("{JET}{hand}"), "jet").unwrap();
    for (path, value) in [("run.coupling", "direct"), ("run.device", "hand")].iter().chain(words) {
        settings::set(&mut scene, path, &Value::parse(value)).unwrap();
    }
    scene
}

fn outcome(scene: &Scene, parts: Parts) -> Result<Outcome, SceneError> {
    let mut scene = scene.clone();
    parts.choose(&mut scene)?;
    let options = RunOptions {
        parts,
        threads: 1,
        pictures_at: &[],
        record: None,
        guide: &mut |_| ControlFlow::Continue(()),
        progress: &mut |_| ControlFlow::Continue(()),
    };
    virtual_clock(&scene, options)
}

/// Force of every tick, N.
fn felt(scene: &Scene, parts: Parts) -> Vec<[f64; 3]> {
    let rows = outcome(scene, parts).unwrap().recording.rows;
    rows.iter().map(|row| row.sent.force.to_array()).collect()
}

fn fluid_parts(fluid: PluginFluid) -> Parts {
    let mut parts = Parts::default();
    parts.backends.insert(fluid.name().into(), Arc::new(move |config| fluid.create(config)));
    parts
}

fn jet_parts() -> Parts {
    fluid_parts(Extensions::load(jet_fluid()).unwrap().fluid.unwrap())
}

fn coupling_parts(coupling: PluginCoupling) -> Parts {
    let mut parts = Parts::default();
    parts.couplings.insert(coupling.name().into(), Arc::new(move || coupling.create()));
    parts
}

#[test]
fn a_jet_in_c_feels_as_the_built_in_one() {
    // Steady; and intermittent, and off to the side, so that part of the jet misses.
    let words = [
        ("source.tap.period", "0.1"),
        ("source.tap.duty", "0.7"),
        ("source.tap.position", "[0.012, 0.05, 0]"),
    ];
    for words in [&words[..0], &words[..]] {
        let scene = scene(words);
        let (own, plugins) = (felt(&scene, Parts::default()), felt(&scene, jet_parts()));
        assert_eq!(own.len(), plugins.len());
        let most = own.iter().map(|f| f[1].abs()).fold(0.0, f64::max);
        assert!(most > 0.05, "{most}");
        for (a, b) in own.iter().zip(&plugins) {
            assert!((0..3).all(|i| (a[i] - b[i]).abs() <= 1e-12 * (1.0 + most)), "{a:?} {b:?}");
        }
    }
}

#[test]
fn settings_that_change_reach_a_plugins_fluid() {
    let mut scene = scene(&[]);
    let change = "[[change]]\nat_s = 0.1\nsource.tap.speed = 0.5\nfluid.rest_density = 800\n";
    scene.changes = parse(&format!("{JET}{change}"), "change").unwrap().changes;
    let (own, plugins) = (felt(&scene, Parts::default()), felt(&scene, jet_parts()));
    assert!(own[150][1].abs() < 0.5 * own[90][1].abs(), "{own:?}");
    assert!(own.iter().zip(&plugins).all(|(a, b)| (a[1] - b[1]).abs() <= 1e-12));
}

/// A tetrahedron, m.
const TETRAHEDRON: &str = "v 0 0 0\nv 0.02 0 0\nv 0 0.02 0\nv 0 0 0.02\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

#[test]
fn what_a_plugins_fluid_cannot_do_is_said() {
    let said = |scene: &Scene| outcome(scene, jet_parts()).unwrap_err().to_string();
    let local = said(&scene(&[("run.coupling", "local")]));
    assert!(local.starts_with("run.coupling = \"local\": must be direct or momentum: "), "{local}");
    let pool = "[[pool]]\nmin = [-0.05, -0.1, -0.05]\nmax = [0.05, -0.05, 0.05]\n";
    let mut pool = parse(&format!("{JET}{pool}"), "pool").unwrap();
    pool.run.coupling = scene(&[]).run.coupling;
    assert_eq!(said(&pool), "backend jet-fluid: no pools of fluid (only sources)");
    let file = scratch().join("plugin-mesh.obj");
    fs::write(&file, TETRAHEDRON).unwrap();
    let file = format!("{:?}", file.to_str().unwrap());
    let mesh = said(&scene(&[("tool.shape", "mesh"), ("tool.file", &file)]));
    assert!(mesh.starts_with("backend jet-fluid: bodies that are meshes"), "{mesh}");
}

#[test]
fn a_part_is_chosen_by_its_name() {
    let named = |name: &str| scene(&[("plugin.backend", name)]);
    assert!(felt(&named("jet-fluid"), jet_parts()).iter().any(|f| f[1] < -0.05));
    let wrong = outcome(&named("jet"), jet_parts()).unwrap_err().to_string();
    assert_eq!(wrong, "plugin.backend = \"jet\": must be one of those that plugins bring: jet-fluid");
    let none = outcome(&named("jet-fluid"), Parts::default()).unwrap_err().to_string();
    assert!(none.contains("must be empty, as no plugin is loaded that brings one"), "{none}");

    let mut two = jet_parts();
    let jet = Arc::clone(&two.backends["jet-fluid"]);
    two.backends.insert("other".into(), jet);
    let several = outcome(&scene(&[]), two.clone()).unwrap_err().to_string();
    assert!(several.ends_with("must be one of those that plugins bring: jet-fluid, other"), "{several}");
    assert!(outcome(&named("other"), two).is_ok());
}

const FLUID: &str = "static int steps;\nstatic void destroy(void* f) { (void)f; }\n\
    static hapflow_result create(const hapflow_fluid_config* c, void** f, char* r, size_t n) {\n\
    (void)c; (void)r; (void)n; steps = 0; *f = &steps; CREATE }\n\
    static hapflow_result configure(void* f, const hapflow_fluid_config* c, char* r, size_t n) {\n\
    (void)f; (void)c; (void)r; (void)n; return HAPFLOW_OK; }\n\
    static hapflow_result step(void* f, const hapflow_fluid_frame* frame, hapflow_fluid_result* r) {\n\
    (void)f; (void)frame; r->loads[0].pressure_force[1] = 1; steps++;\n\
    r->substeps = UINT64_MAX; STEP return HAPFLOW_OK; }\n\
    const hapflow_fluid_backend_extension table = { .size = SIZE, .name = NAME, .create = create,\n\
    .configure = configure, .step = step, .destroy = DESTROY };\n\
    const void* hapflow_extension(const char* name) { (void)destroy; return strcmp(name, TABLE) ? NULL : &table; }";

/// The plugin above with some words in place of its own.
fn fluid(name: &str, words: &[(&str, &str)]) -> PathBuf {
    let usual = [
        ("CREATE", "return HAPFLOW_OK;"),
        ("STEP", ""),
        ("SIZE", "sizeof table"),
        ("NAME", "\"bad\""),
        ("DESTROY", "destroy"),
        ("TABLE", "HAPFLOW_EXTENSION_FLUID_BACKEND"),
    ];
    let text = words.iter().chain(&usual).fold(FLUID.to_string(), |text, (word, c)| text.replace(word, c));
    written(name, &text)
}

#[test]
fn a_fluid_that_fails_while_it_runs_is_not_felt_and_says_why() {
    let sound = Extensions::load(&fluid("sound", &[])).unwrap().fluid.unwrap();
    let force = felt(&scene(&[]), fluid_parts(sound.clone()));
    assert!(force[130..].iter().all(|f| f[1] > 0.9) && sound.failure().is_none());
    for (name, step, why) in [
        ("nan", "r->loads[0].pressure_force[1] = NAN;", "step gave body 0 a load that is not finite"),
        ("fails", "return HAPFLOW_ERROR_UNSUPPORTED;", "step gave result -"),
        ("astray", "r->states[0].position[0] = INFINITY;", "step gave body 0 a motion that cannot be: "),
        ("twisted", "r->states[0].orientation[3] = 0.5;", "step gave body 0 a motion that cannot be: "),
    ] {
        // Only in its eleventh frame, and never again: the fault stays.
        let plugin = Extensions::load(&fluid(name, &[("STEP", &format!("if (steps == 11) {{ {step} }}"))]));
        let plugin = plugin.unwrap().fluid.unwrap();
        let outcome = outcome(&scene(&[]), fluid_parts(plugin.clone())).unwrap();
        let force: Vec<_> = outcome.recording.rows.iter().map(|row| row.sent.force).collect();
        assert!(force[109].y > 0.5, "{name} {}", force[109]);
        assert!(force[111..].iter().all(|f| *f == DVec3::ZERO), "{name} {:?}", &force[108..114]);
        assert!(outcome.faults.contains(FaultSet::FLUID_FAULT), "{name} {}", outcome.faults);
        let reason = plugin.failure().unwrap();
        assert!(
            reason.starts_with("fluid bad, frame that ends at 0.110 s: ") && reason.contains(why),
            "{reason}"
        );
    }
}

#[test]
fn a_broken_plugin_is_refused_with_the_reason() {
    for (name, words, why) in [
        ("short", [("SIZE", "8")], "its table hapflow.fluid-backend/1 has 8 bytes and must have 56"),
        ("null", [("DESTROY", "NULL")], "its function destroy is null"),
        ("nameless", [("NAME", "NULL")], "its name is null"),
        ("unnamed", [("NAME", "\"\"")], "its name is empty"),
        ("binary", [("NAME", "\"\\xff\"")], "its name is not UTF-8"),
        (
            "later",
            [("TABLE", "\"hapflow.fluid-backend/2\"")],
            "it brings none of hapflow.fluid-backend/1, hapflow.device/1, hapflow.coupling/1",
        ),
    ] {
        let said = refused(&fluid(name, &words));
        assert!(said.ends_with(&format!("libplugin-{name}.so: {why}")), "{said}");
    }
    let missing = refused(Path::new("/no/such/plugin.so"));
    assert!(missing.starts_with("/no/such/plugin.so: "), "{missing}");
    let none = refused(&written("none", "int nothing;"));
    assert!(none.contains("undefined symbol: hapflow_extension"), "{none}");
    let text = scratch().join("plugin-text.so");
    fs::write(&text, "no library\n").unwrap();
    assert!(refused(&text).contains("plugin-text.so: "));
}

#[test]
fn a_fluid_that_cannot_be_made_says_why() {
    for (name, create, why) in [
        ("told", "strcpy(r, \"no licence\"); return HAPFLOW_ERROR_UNSUPPORTED;", "backend bad: no licence"),
        ("silent", "return -77;", "backend bad: result -77"),
    ] {
        let plugin = Extensions::load(&fluid(name, &[("CREATE", create)])).unwrap().fluid.unwrap();
        assert_eq!(outcome(&scene(&[]), fluid_parts(plugin)).unwrap_err().to_string(), why);
    }
}

#[test]
fn a_plugin_is_found_by_its_name() {
    let file = jet_fluid();
    let path = std::env::join_paths([Path::new("/no/such"), file.parent().unwrap()]).unwrap();
    assert_eq!(find("jet_fluid", Some(&path)).unwrap(), file);
    assert_eq!(find("some/file.so", None).unwrap(), Path::new("./some/file.so"));
    // Not where the system has its libraries.
    assert_eq!(find("file.so", Some(&path)).unwrap(), Path::new("./file.so"));
    let none = find("no_such", Some(&path)).unwrap_err().to_string();
    assert!(none.contains("no libno_such.so in HAPFLOW_PLUGIN_PATH (/no/such, "), "{none}");
    assert!(find("no_such", None).unwrap_err().to_string().contains("(which is not set)"));
}

#[test]
fn a_device_in_cpp_moves_the_tool() {
    let file = built(&root().join("examples/plugins/bobbing_device.cpp"), "bobbing_device");
    let plugin = Extensions::load(&file).unwrap();
    assert!(plugin.fluid.is_none() && plugin.coupling.is_none());
    let device = plugin.device.unwrap();
    assert_eq!(device.name(), "bobbing_device");
    let mut open = device.open(DVec3::X).unwrap();
    assert!(device.open(DVec3::X).err().unwrap().to_string().contains("result -6"), "it is open already");
    let state = open.read(0.125).unwrap();
    assert!((state.position - DVec3::new(1.0, 1e-3, 0.0)).length() < 1e-12, "{state:?}");
    assert!(state.velocity.length() < 1e-12, "{state:?}");
    open.write(GatedWrench::ZERO, 1e-3).unwrap();
    open.close();
    assert!(open.read(0.2).is_err());
    device.open(DVec3::X).unwrap();

    let mut parts = Parts::default();
    parts.devices.insert(device.name().into(), Arc::new(move |origin| device.open(origin)));
    let refused = outcome(&scene(&[]), parts).unwrap_err().to_string();
    assert!(refused.contains("real time only"), "{refused}");
    let none = hapflow::engine::open_device(&scene(&[("plugin.device", "bobbing_device")]));
    assert!(none.err().unwrap().to_string().contains("no plugin is loaded"));
}

const DEVICE: &str = "static hapflow_result config_init(hapflow_device_config* c, uint32_t n) {\n\
    (void)c; (void)n; return 0; }\n\
    static hapflow_result open(const hapflow_device_config* c, hapflow_device* d) {\n\
    (void)c; d->id = 1; return OPEN; }\n\
    static hapflow_result close(hapflow_device d) { (void)d; return 0; }\n\
    static hapflow_result read(hapflow_device d, double t, hapflow_tool_state* s) { (void)d;\n\
    if (t == 1) s->position[0] = NAN;\n\
    if (t == 2) s->orientation[3] = 0.5;\n\
    if (t == 3) s->velocity[2] = 1e30;\n\
    return t == 4 ? HAPFLOW_ERROR_DEVICE : HAPFLOW_OK; }\n\
    static hapflow_result write(hapflow_device d, const hapflow_wrench* w, double t) {\n\
    (void)d; (void)w; (void)t; return HAPFLOW_ERROR_DEVICE; }\n\
    static const hapflow_device_extension table = { sizeof table, 0, config_init, open, close, read, WRITE, close };\n\
    const void* hapflow_extension(const char* name) { (void)write;\n\
    return strcmp(name, HAPFLOW_EXTENSION_DEVICE) ? NULL : &table; }";

#[test]
fn a_device_that_is_nowhere_is_lost() {
    let device = |name: &str, open: &str, write: &str| {
        let file = written(name, &DEVICE.replace("OPEN", open).replace("WRITE", write));
        Extensions::load(&file).map(|plugin| plugin.device.unwrap())
    };
    let mut lost: Box<dyn HapticDevice> = device("lost", "0", "write").unwrap().open(DVec3::ZERO).unwrap();
    assert!(lost.read(0.5).is_ok());
    for time_s in [1.0, 2.0, 3.0] {
        let error = lost.read(time_s).unwrap_err().to_string();
        assert!(error.contains("plugin-lost does not answer any more, it says where it is in no"), "{error}");
    }
    assert!(lost.read(4.0).unwrap_err().to_string().contains("it cannot be read"));
    assert!(lost.write(GatedWrench::ZERO, 1e-3).unwrap_err().to_string().contains("it takes no force"));
    let shut = device("shut", "-5", "write").unwrap().open(DVec3::ZERO).err().unwrap();
    assert!(shut.to_string().contains("plugin-shut cannot be opened, result -5"), "{shut}");
    let null = device("deaf", "0", "NULL").err().unwrap().to_string();
    assert!(null.ends_with("its function write is null"), "{null}");
}

const COUPLING: &str = "static int it;\n\
    static hapflow_result create(void** c) { *c = &it; return CREATE; }\n\
    static hapflow_result begin(void* c, const hapflow_coupling_frame* f, uint32_t* d, double v[3]) {\n\
    (void)c; (void)f; (void)d; (void)v; return BEGIN; }\n\
    static hapflow_result end(void* c, const hapflow_coupling_frame* f, hapflow_wrench* w) {\n\
    (void)c; for (int i = 0; i < 3; i++) w->force[i] = f->load.force[i] * SHARE; return END; }\n\
    static void destroy(void* c) { (void)c; }\n\
    static const hapflow_coupling_extension table = { sizeof table, 0, \"share\", create, begin, end, destroy };\n\
    const void* hapflow_extension(const char* name) {\n\
    return strcmp(name, HAPFLOW_EXTENSION_COUPLING) ? NULL : &table; }";

fn coupling(name: &str, words: &[(&str, &str)]) -> PluginCoupling {
    let usual = [("CREATE", "0"), ("BEGIN", "0"), ("SHARE", "0.5"), ("END", "0")];
    let text = words.iter().chain(&usual).fold(COUPLING.to_string(), |text, (word, c)| text.replace(word, c));
    Extensions::load(&written(name, &text)).unwrap().coupling.unwrap()
}

#[test]
fn a_coupling_says_what_is_felt() {
    // Even where the scene's own is one that looks at the fluid, with another filter. A hand that gave way would feel more.
    let still = [("run.device", "null"), ("source.tap.period", "0.1"), ("source.tap.duty", "0.7")];
    let whole = felt(&scene(&still), Parts::default());
    let local = scene(&[&still[..], &[("run.coupling", "local")]].concat());
    let half = felt(&local, coupling_parts(coupling("half", &[])));
    assert!(whole.iter().any(|f| f[1] < -0.05));
    // The gate's ramp is the same for both; its slew is not reached.
    assert!(whole.iter().zip(&half).all(|(w, h)| (0..3).all(|i| (h[i] - w[i] / 2.0).abs() < 1e-12)));
}

#[test]
fn a_coupling_that_fails_is_not_felt_and_says_why() {
    for (name, word, why) in [
        ("ends-badly", ("END", "-1"), "coupling share: end gave result -1"),
        ("begins-badly", ("BEGIN", "-2"), "coupling share: begin gave result -2"),
        ("too-fast", ("BEGIN", "(v[0] = 1e4, 0)"), "coupling share: begin gave numbers that cannot be"),
        ("infinite", ("SHARE", "INFINITY"), "coupling share: end gave numbers that cannot be"),
    ] {
        let coupling = coupling(name, &[word]);
        let outcome = outcome(&scene(&[]), coupling_parts(coupling.clone())).unwrap();
        assert!(outcome.recording.rows.iter().all(|row| row.sent.force == DVec3::ZERO), "{name}");
        assert!(outcome.faults.contains(FaultSet::FLUID_FAULT), "{name}");
        assert_eq!(coupling.failure(), Some(why));
    }
    let none = outcome(&scene(&[]), coupling_parts(coupling("unmade", &[("CREATE", "-9")])));
    assert_eq!(none.unwrap_err().to_string(), "coupling share cannot be made: result -9");
}
