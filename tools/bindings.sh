#!/usr/bin/env bash
# Writes the headers' types, numbers and prototypes in Rust: for crates/capi to be checked against, and, with functions that
# are looked up in a library, for crates/host:
#
#     tools/bindings.sh            writes crates/capi/src/generated.rs and crates/host/src/generated.rs
#     tools/bindings.sh --check    fails if one of them is not what the header says
#
# Needs bindgen of the version below (cargo install bindgen-cli --locked --version VERSION) and libclang
# (Debian: apt-get install libclang1-14 libclang-common-14-dev, or libclang-dev). BINDGEN may name another program.
set -euo pipefail

version=0.73.2
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bindgen=${BINDGEN:-bindgen}

generate() { # generate OPTION...
    # C11 has no fixed width for enumerations, so that these are plain numbers; a formatter of its own makes the
    # result the same whichever rustfmt there is.
    # hapflow.h includes all others.
    "$bindgen" include/hapflow/hapflow.h \
        --allowlist-item '(hapflow|HAPFLOW)_.*' \
        --rust-target 1.85 --rust-edition 2024 --use-core \
        --default-enum-style consts --no-doc-comments "$@" \
        --formatter prettyplease --disable-header-comment \
        --raw-line '//! The header in Rust, by tools/bindings.sh: not to be edited.' \
        --raw-line '#![allow(dead_code, missing_docs, non_camel_case_types, unsafe_op_in_unsafe_fn, clippy::all)]' \
        --raw-line '#![allow(clippy::undocumented_unsafe_blocks, clippy::missing_safety_doc)]' \
        -- -std=c11 -Iinclude |
        # Sizes and offsets are those of 64-bit processors.
        sed 's/^const _: () = {/#[cfg(target_pointer_width = "64")]\n&/'
}

found=$("$bindgen" --version 2>/dev/null || true)
[[ $found == "bindgen $version" ]] || {
    echo "needs bindgen $version (cargo install bindgen-cli --locked --version $version), not ${found:-none}" >&2
    exit 2
}

keep() { # keep FILE OPTION...
    local text
    text=$(generate "${@:2}")
    if [[ $check != --check ]]; then
        echo "$text" >"$1"
        return
    fi
    diff <(echo "$text") "$1" || {
        echo "$1 is not what the header says: run tools/bindings.sh" >&2
        exit 1
    }
    echo "$1 is up to date"
}

check=${1:-}
keep crates/capi/src/generated.rs --merge-extern-blocks
keep crates/host/src/generated.rs --dynamic-loading Functions --dynamic-link-require-all
