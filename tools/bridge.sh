#!/usr/bin/env bash
# Writes the C++ half of the cxx bridge, of crates/cxx-bridge/src/lib.rs and of the crate cxx itself, into cpp/cxx/:
#
#     tools/bridge.sh            writes cpp/cxx/
#     tools/bridge.sh --check    fails if a file there is another
#
# Needs cxxbridge of the version in crates/cxx-bridge/Cargo.toml (cargo install cxxbridge-cmd --locked --version VERSION).
# CXXBRIDGE may name another program.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
cxxbridge=${CXXBRIDGE:-cxxbridge}
version=$(sed -n 's/^cxx = "=\(.*\)"$/\1/p' crates/cxx-bridge/Cargo.toml)
found=$("$cxxbridge" --version 2>/dev/null || true)
[[ $found == "cxxbridge $version" ]] || {
    echo "needs cxxbridge $version (cargo install cxxbridge-cmd --locked --version $version), not ${found:-none}" >&2
    exit 2
}

into=cpp/cxx
[[ ${1:-} == --check ]] && into=$(mktemp -d)
mkdir -p "$into/include/rust" "$into/include/hapflow/cxx"
source=crates/cxx-bridge/src/lib.rs
"$cxxbridge" --header >"$into/include/rust/cxx.h"
"$cxxbridge" "$source" --header >"$into/include/hapflow/cxx/bridge.h"
"$cxxbridge" "$source" --include hapflow/cxx/bridge.h >"$into/bridge.cc"
# Its own C++ comes with the crate.
crate=$(cargo metadata --locked --format-version 1 | grep -o '"manifest_path":"[^"]*/cxx-'"$version"'/Cargo.toml"')
cp "$(dirname "$(cut -d'"' -f4 <<<"$crate")")/src/cxx.cc" "$into/cxx.cc"
sed -i 's|#include "../include/cxx.h"|#include "rust/cxx.h"|' "$into/cxx.cc"
if [[ $into != cpp/cxx ]]; then
    diff -r "$into" cpp/cxx || {
        echo "cpp/cxx is not what the bridge says: run tools/bridge.sh" >&2
        exit 1
    }
    rm -rf "$into"
    echo "cpp/cxx is up to date"
fi
