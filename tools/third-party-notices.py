#!/usr/bin/env python3
"""Prints THIRD-PARTY-NOTICES.md: whose work is inside the built program and libhapflow, and on what terms.

Run it from anywhere after a change of Cargo.lock:

    python3 tools/third-party-notices.py > THIRD-PARTY-NOTICES.md

Needs only Cargo and Python's standard library. Reads the licence files of the crates in Cargo's own registry cache.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BINARIES = ("hapflow-app", "hapflow-capi", "hapflow-cxx-bridge")
PLATFORMS = (
    "x86_64-unknown-linux-gnu",
    "aarch64-unknown-linux-gnu",
    "x86_64-pc-windows-msvc",
    "x86_64-apple-darwin",
    "aarch64-apple-darwin",
)
# Where a crate offers several licences, the first of these is taken; the second field tells its text from others.
TAKEN = {
    "MIT": "Permission is hereby granted, free of charge",
    "Apache-2.0": "Apache License",
    "ISC": "Permission to use, copy, modify, and/or distribute this software",
    "Unicode-3.0": "UNICODE LICENSE V3",
    "Zlib": "This software is provided 'as-is'",
}
LICENCE_FILE = re.compile(r"(?i)^(un)?(licen[cs]e|copying|copyright|notice)")
# Not the "Copyright [yyyy] [name of copyright owner]" that the Apache licence prints as a pattern.
# Libraries in C whose source a crate carries and builds in: name, licence file in the crate, terms.
BUNDLED = {
    "libusb1-sys": (
        "libusb",
        "libusb/COPYING",
        "LGPL-2.1-or-later, Copyright 2001-2024 its authors, <https://libusb.info>; unchanged. Its source comes with the"
        " crate libusb1-sys; with hapflow's own source, which is public, a program with another libusb can be built."
        " `cargo build --no-default-features -p hapflow-app` leaves it out",
    ),
    "hidapi": (
        "hidapi",
        "etc/hidapi/LICENSE-bsd.txt",
        "BSD-3-Clause, Copyright Alan Ott and Signal 11 Software, <https://github.com/libusb/hidapi>; on Windows and macOS",
    ),
}
COPYRIGHT = re.compile(r"copyright (\(c\)|©|\d{4})(?!.*\byyyy\b).*", re.IGNORECASE)


def cargo(*words):
    command = ["cargo", words[0], "--locked", *words[1:]]
    return subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout


def reachable(kinds):
    """Names and versions of the crates that the binaries need, over edges of these kinds, on any platform.

    `cargo tree` knows which optional crates are really on; the graph in `cargo metadata` has more.
    """
    roots = [word for binary in BINARIES for word in ("-p", binary)]
    targets = [word for platform in PLATFORMS for word in ("--target", platform)]
    tree = cargo("tree", *roots, *targets, "--edges", kinds, "--prefix", "none", "--format", "{p}")
    return {(line.split()[0], line.split()[1].removeprefix("v")) for line in tree.splitlines() if line}


def taken(expression):
    """The licences under which a crate is used, of its SPDX expression."""
    names = []
    for part in expression.split(" AND "):
        offered = [o.strip() for o in re.split(r" OR |/", part.strip().strip("()"))]
        names.append(next((name for name in TAKEN if name in offered), None))
    if None in names:
        sys.exit(f"{sys.argv[0]}: no known licence in '{expression}': add it to TAKEN, and to deny.toml")
    return names


def files(package):
    folder = Path(package["manifest_path"]).parent
    return {
        f.name: f.read_text(errors="replace")
        for f in sorted(folder.iterdir())
        if LICENCE_FILE.match(f.name) and f.is_file()
    }


def licence_text(package, name):
    """The crate's own file with the text of that licence; the one with fewest other words."""
    texts = [t for t in files(package).values() if TAKEN[name] in t]
    return min(texts, key=len) if texts else None


def words(text):
    return re.sub(r"[^a-z]+", " ", text.lower()).strip()


def head(text, first_words):
    """The copyright lines above the body of a licence."""
    lines = [line.strip() for line in text.partition(first_words)[0].splitlines()]
    return [
        line
        for line in lines
        if line and not re.fullmatch(r"[-=#*]*|#* *(the )?mit license( \(mit\))?:?", line, re.IGNORECASE)
    ]


def elsewhere(package):
    """Copyright lines in any licence file of a crate."""
    lines = [line.strip() for text in files(package).values() for line in text.splitlines()]
    return list(dict.fromkeys(line for line in lines if COPYRIGHT.fullmatch(line)))


def body(text, first_words):
    return words(first_words + text.partition(first_words)[2])


def fence(text):
    lines = "\n".join(line.rstrip() for line in text.strip("\n").splitlines())
    return f"```text\n{lines}\n```\n"


def entry(package, rights):
    """A crate's lines in the lists."""
    where = package["repository"] or package["homepage"] or f"https://crates.io/crates/{package['name']}"
    rights = rights or elsewhere(package)
    if not rights:
        rights = ["no copyright line in its licence"]
        if package["authors"]:
            rights.append("authors: " + ", ".join(package["authors"]))
    rights = "; ".join(rights).replace("<", "\\<").replace("*", "\\*")
    return f"- **{package['name']} {package['version']}** ({package['license']}), <{where}>  \n  {rights}"


def order(package):
    return package["name"], [int(n) for n in re.findall(r"\d+", package["version"])]


def collect():
    """The crates inside the binaries, and those that only build them."""
    packages = json.loads(cargo("metadata", "--format-version", "1"))["packages"]
    foreign = sorted((p for p in packages if p["source"]), key=order)
    inside = reachable("normal,no-proc-macro")
    tools = reachable("normal,build") - inside
    return (
        [p for p in foreign if (p["name"], p["version"]) in inside],
        [p for p in foreign if (p["name"], p["version"]) in tools],
    )


def shared_text(name):
    """The text that stands once for all crates under a licence; "" where each brings its own."""
    if name == "MIT":
        return TAKEN[name] + (ROOT / "LICENSE-MIT").read_text().partition(TAKEN[name])[2]
    return (ROOT / "LICENSE-APACHE").read_text() if name == "Apache-2.0" else ""


def group(crates, name):
    """The list of the crates under one licence, and the texts that have to be printed whole."""
    entries, whole = [], []
    for crate in (c for c in crates if name in taken(c["license"])):
        text = licence_text(crate, name)
        rights = []
        # Crates without a licence file do occur, and the MIT text is the same for all that have none.
        if text is None and name != "MIT":
            sys.exit(f"{sys.argv[0]}: {crate['name']} has no file with its {name} text")
        if text and name == "MIT":
            rights = head(text, TAKEN[name])
        if text and name != "Apache-2.0" and body(text, TAKEN[name]) != words(shared_text(name)):
            rights = ["its licence is printed whole further down"]
            whole.append((f"{crate['name']} {crate['version']}", text))
        entries.append(entry(crate, rights))
    return entries, whole


INTRODUCTION = """# Third-party notices

hapflow itself is under MIT or Apache-2.0, at your choice: see LICENSE-MIT and LICENSE-APACHE.

This file lists the work of others that ends up in `hapflow`, `libhapflow` and `libhapflow_cxx`: {} crates, the Rust
standard library and one font. Ship it with every binary. It covers the builds for Linux, Windows and macOS; one for a
single system holds a few crates less. Where a crate offers several licences, the heading says which is taken.

Made from Cargo.lock and the crates' own licence files with

```sh
python3 tools/third-party-notices.py > THIRD-PARTY-NOTICES.md
```
"""

FONT = """## Font

**Inter Regular** (crates/app/fonts/Inter-Regular.ttf), inside the program `hapflow`: SIL Open Font License 1.1,
Copyright 2020 The Inter Project Authors, <https://github.com/rsms/inter>
"""

STANDARD_LIBRARY = """## Rust standard library

MIT OR Apache-2.0, Copyright The Rust Project Developers, <https://github.com/rust-lang/rust>; taken under MIT, text
below. The notices of the crates inside it come with each Rust toolchain, as `share/doc/rust/COPYRIGHT-library.html`.
Its Unicode tables are under this licence:
"""

TOOLS = """## Used only to build

Procedural macros, build scripts and what they need; none of them is inside the binaries.
"""


def main():
    crates, tools = collect()
    unicode_text = next(t for t in (licence_text(p, "Unicode-3.0") for p in crates + tools) if t)
    parts = [INTRODUCTION.format(len(crates)), FONT, fence((ROOT / "crates/app/fonts/OFL.txt").read_text())]
    parts += [STANDARD_LIBRARY, fence(unicode_text)]
    printed_whole = []
    for name in TAKEN:
        entries, whole = group(crates, name)
        printed_whole += whole
        if entries:
            parts += [f"## Crates under {name}\n", "\n".join(entries) + "\n"]
            if shared_text(name):
                parts += ["Under this text:\n", fence(shared_text(name))]
    for crate in crates:
        notices = {f: t for f, t in files(crate).items() if f.lower().startswith("notice")}
        printed_whole += [(f"{crate['name']} {crate['version']}: {f}", t) for f, t in notices.items()]
    for crate in (c for c in crates if c["name"] in BUNDLED):
        name, licence, terms = BUNDLED[crate["name"]]
        text = (Path(crate["manifest_path"]).parent / licence).read_text()
        parts += [f"## {name}, in C\n", f"Inside the program `hapflow`, and in `libhapflow` where it was built with the feature `falcon` or `hid`: {terms}.\n", fence(text)]
    if printed_whole:
        parts.append("## Printed whole\n")
        parts += [f"### {title}\n\n{fence(text)}" for title, text in printed_whole]
    parts += [TOOLS, "\n".join(f"- {p['name']} {p['version']} ({p['license']})" for p in tools) + "\n"]
    sys.stdout.write("\n".join(parts))


if __name__ == "__main__":
    main()
