#!/usr/bin/env bash
# Installs libhapflow for programs in C, C++ and Python, and packs it. From any folder:
#
#     tools/dist.sh                     into dist/hapflow-VERSION-TARGET
#     tools/dist.sh --prefix DIR        into DIR, as /usr/local
#     tools/dist.sh --tarball           also dist/hapflow-VERSION-TARGET.tar.gz: the same bytes from the same library
#     tools/dist.sh --library FILE      takes this libhapflow.so and the libhapflow_cxx.so beside it, and builds none
#
# What comes out finds itself wherever it is moved to, by CMake and pkg-config. For Linux; needs Rust and binutils.
set -euo pipefail

from=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")/.."

fail() {
    echo "dist.sh: $*" >&2
    exit 2
}

# A path as it was meant where the script was called.
there() {
    [[ -n $1 ]] || fail "an empty path"
    (cd "$from" && realpath -m -- "$1")
}

prefix= library= tarball=
while (($#)); do
    case $1 in
        --prefix | --library)
            (($# > 1)) || fail "$1 needs a path"
            path=$(there "$2")
            [[ $1 == --prefix ]] && prefix=$path || library=$path
            shift 2
            ;;
        --tarball) tarball=yes && shift ;;
        -h | --help) sed -n '2,/^set/{s/^# \{0,1\}//p}' tools/dist.sh && exit ;;
        *) fail "no option $1: there are --prefix DIR, --tarball and --library FILE" ;;
    esac
done

version=$(sed -n '/^\[workspace.package\]/,/^\[/s/^version = "\(.*\)"$/\1/p' Cargo.toml)
[[ $version =~ ^[0-9]+\.[0-9]+\.[0-9]+ ]] || fail "Cargo.toml has no version"
target=$(rustc -vV | sed -n 's/^host: //p')
[[ $target == *-linux-* ]] || fail "$target: only Linux has an install step yet"
name=hapflow-$version-$target

if [[ -z $library ]]; then
    # Without the builder's folders in it, so that it is the same from everywhere. Such flags rebuild every crate: in a
    # folder of its own it leaves the other builds alone.
    export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-target}/dist
    RUSTFLAGS="${RUSTFLAGS:-} --remap-path-prefix=${CARGO_HOME:-$HOME/.cargo}=/cargo --remap-path-prefix=$PWD=/hapflow" \
        cargo build --locked --release -p hapflow-capi -p hapflow-cxx-bridge
    library=$CARGO_TARGET_DIR/release/libhapflow.so
fi
bridge=$(dirname "$library")/libhapflow_cxx.so
for file in "$library" "$bridge"; do
    [[ -f $file ]] || fail "$file: no such file"
done

# --- The tree -------------------------------------------------------------------------------------

stage=$(mktemp -d)
trap 'rm -rf "$stage"' EXIT
tree=$stage/$name

put() { # put FOLDER FILE...
    install -d -m 755 "$tree/$1"
    install -m 644 -t "$tree/$1" -- "${@:2}"
}

fill_in() { # fill_in TEMPLATE FILE
    sed -e "s/@VERSION@/$version/" -e "s/@POINTER_BYTES@/$pointer_bytes/" "$1" >"$stage/filled"
    install -D -m 644 "$stage/filled" "$tree/$2"
}

# The fifth byte of an ELF file is its class.
[[ $(od -An -tu1 -j4 -N1 "$library") -eq 2 ]] && pointer_bytes=8 || pointer_bytes=4

umask 022
install -d -m 755 "$tree/lib"
strip --strip-unneeded -o "$tree/lib/libhapflow.so" "$library"
strip --strip-unneeded -o "$tree/lib/libhapflow_cxx.so" "$bridge"
chmod 755 "$tree"/lib/*.so
put include/hapflow include/hapflow/*.h cpp/include/hapflow/*.hpp
put include/hapflow/cxx cpp/cxx/include/hapflow/cxx/bridge.h
put include/rust cpp/cxx/include/rust/cxx.h
put share/hapflow/cxx cpp/cxx/*.cc
put lib/cmake/hapflow cpp/cmake/hapflowConfig.cmake
fill_in cpp/cmake/hapflowConfigVersion.cmake.in lib/cmake/hapflow/hapflowConfigVersion.cmake
fill_in cpp/pkgconfig/hapflow.pc.in lib/pkgconfig/hapflow.pc
put share/doc/hapflow README.md LICENSE-APACHE LICENSE-MIT THIRD-PARTY-NOTICES.md CHANGELOG.md
put share/hapflow/scenes scenes/*.toml
put share/hapflow/examples examples/*.c examples/*.cpp examples/*.py
for adapter in cpp/adapters/*/; do
    (cd cpp && find "${adapter#cpp/}" -type f) | while read -r file; do put "share/hapflow/$(dirname "$file")" "cpp/$file"; done
done
put share/hapflow/adapters cpp/adapters/CMakeLists.txt
put share/hapflow/examples/cmake-consumer examples/cmake-consumer/{CMakeLists.txt,main.cpp}
put share/hapflow/examples/plugins examples/plugins/{CMakeLists.txt,*.c,*.cpp}

# --- Where it goes --------------------------------------------------------------------------------

if [[ -z $prefix ]]; then
    prefix=$PWD/dist/$name
    rm -rf "$prefix"
fi
mkdir -p "$prefix"
# File by file under a new name first: a program may have the old library mapped.
(cd "$tree" && find . -type f -printf '%P\0') | while IFS= read -r -d '' file; do
    mkdir -p "$prefix/$(dirname "$file")"
    cp -p "$tree/$file" "$prefix/$file.new"
    mv -f "$prefix/$file.new" "$prefix/$file"
done
echo "$prefix"

if [[ -n $tarball ]]; then
    mkdir -p dist
    # 1980: the oldest time that all tools can handle.
    tar -C "$stage" --format=ustar --sort=name --mtime="@${SOURCE_DATE_EPOCH:-315532800}" --owner=0 --group=0 \
        --numeric-owner -cf - "$name" | gzip -9n >"$stage/$name.tar.gz"
    mv -f "$stage/$name.tar.gz" "dist/$name.tar.gz"
    echo "$PWD/dist/$name.tar.gz"
fi
