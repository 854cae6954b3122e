#!/usr/bin/env bash
# Writes the headers' types, numbers and prototypes in Rust, for crates/capi to be checked against:
#
#     tools/bindings.sh            writes crates/capi/src/generated.rs
#     tools/bindings.sh --check    fails if that file is not what the header says
#
# Needs bindgen of the version below (cargo install bindgen-cli --locked --version VERSION) and libclang
# (Debian: apt-get install libclang1-14 libclang-common-14-dev, or libclang-dev). BINDGEN may name another program.
set -euo pipefail

version=0.73.2
cd "$(dirname "${BASH_SOURCE[0]}")/.."
file=crates/capi/src/generated.rs
bindgen=${BINDGEN:-bindgen}

generate() {
    # C11 has no fixed width for enumerations, so that these are plain numbers; a formatter of its own makes the
    # result the same whichever rustfmt there is.
    # hapflow.h includes all others.
    "$bindgen" include/hapflow/hapflow.h \
        --allowlist-item '(hapflow|HAPFLOW)_.*' \
        --rust-target 1.85 --rust-edition 2024 --use-core \
        --default-enum-style consts --merge-extern-blocks --no-doc-comments \
        --formatter prettyplease --disable-header-comment \
        --raw-line '//! The header in Rust, by tools/bindings.sh: not to be edited.' \
        --raw-line '#![allow(dead_code, non_camel_case_types, clippy::all)]' \
        -- -std=c11 -Iinclude |
        # Sizes and offsets are those of 64-bit processors.
        sed 's/^const _: () = {/#[cfg(target_pointer_width = "64")]\n&/'
}

found=$("$bindgen" --version 2>/dev/null || true)
[[ $found == "bindgen $version" ]] || {
    echo "needs bindgen $version (cargo install bindgen-cli --locked --version $version), not ${found:-none}" >&2
    exit 2
}
text=$(generate)
if [[ ${1:-} == --check ]]; then
    diff <(echo "$text") "$file" || {
        echo "$file is not what the header says: run tools/bindings.sh" >&2
        exit 1
    }
    echo "$file is up to date"
else
    echo "$text" >"$file"
fi
