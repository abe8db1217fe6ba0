#!/usr/bin/env bash
# Prepares everything that the two commands need, and only what is missing:
#   - checks for cargo, a C compiler and Python 3;
#   - makes .venv in the repository with the packages of scripts/requirements.txt;
#   - builds the FMU's shared library (physics only) and the command line `iwan`.
#
# Run it from any folder, or source it: it then leaves the variables REPOSITORY, PYTHON, IWAN and
# FMU_LIBRARY, and exports what bindgen needs to find libclang. Progress goes to stderr.
set -euo pipefail

REPOSITORY=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
PYTHON="$REPOSITORY/.venv/bin/python"
IWAN="$REPOSITORY/target/release/iwan"
case "$(uname -s)" in
Darwin) FMU_LIBRARY="$REPOSITORY/target/fmu/release/libiwan.dylib" ;;
*) FMU_LIBRARY="$REPOSITORY/target/fmu/release/libiwan.so" ;;
esac
SETUP_STARTED=$SECONDS

say() {
    printf '[%3d s] %s\n' "$((SECONDS - SETUP_STARTED))" "$*" >&2
}

stop() {
    printf 'setup: %s\n' "$*" >&2
    exit 2
}

require_tools() {
    # rustup installs here and asks for a new shell before cargo is on the path.
    if ! command -v cargo >/dev/null && [ -x "$HOME/.cargo/bin/cargo" ]; then
        export PATH="$HOME/.cargo/bin:$PATH"
    fi
    command -v cargo >/dev/null ||
        stop "cargo is missing: install Rust 1.95 or newer (https://rustup.rs), then run this again"
    command -v cc >/dev/null ||
        stop "a C compiler is missing: install gcc or clang (Debian: apt install gcc libc6-dev)"
    command -v python3 >/dev/null ||
        stop "python3 is missing: install Python 3.10 or newer (Debian: apt install python3 python3-venv)"
    python3 -c 'import sys; sys.exit(sys.version_info < (3, 10))' ||
        stop "$(python3 --version) is too old: Python 3.10 or newer is needed"
}

# Installs again only when the list of packages has changed or an earlier run was interrupted.
prepare_python() {
    local list="$REPOSITORY/scripts/requirements.txt"
    local stamp="$REPOSITORY/.venv/installed.txt"
    if [ -x "$PYTHON" ] && cmp -s "$list" "$stamp" && "$PYTHON" -c 'import fmpy' 2>/dev/null; then
        return
    fi
    if ! "$PYTHON" -m pip --version >/dev/null 2>&1; then
        say "making the Python environment .venv"
        python3 -c 'import ensurepip, venv' 2>/dev/null ||
            stop "python3 cannot make environments: install its venv module (Debian: apt install python3-venv)"
        rm -rf "$REPOSITORY/.venv"
        python3 -m venv "$REPOSITORY/.venv"
    fi
    say "installing the Python packages of scripts/requirements.txt (about 40 s)"
    rm -f "$stamp"
    "$PYTHON" -m pip install --quiet --disable-pip-version-check --requirement "$list" >&2 ||
        stop "pip could not install the packages of scripts/requirements.txt (message above)"
    cp "$list" "$stamp"
}

# The `fmi` crate, by which `iwan check` loads an FMU, generates its bindings with libclang.
# libclang from PyPI comes without the compiler's own headers (stddef.h): those are the C compiler's.
point_to_libclang() {
    LIBCLANG_PATH=$("$PYTHON" -c 'import clang, pathlib; print(pathlib.Path(clang.__path__[0]) / "native")')
    export LIBCLANG_PATH
    local headers
    headers=$(cc -print-file-name=include)
    if [ -d "$headers" ]; then
        export BINDGEN_EXTRA_CLANG_ARGS="-I$headers"
    fi
}

# The library has a target folder of its own: the same file name with all features would replace it.
build() {
    local loudness=(--quiet)
    if [ ! -x "$IWAN" ]; then
        say "building for the first time: about three minutes on two cores"
        loudness=()
    fi
    # A folder that the user's environment names elsewhere would hide the programs from the scripts.
    export CARGO_TARGET_DIR="$REPOSITORY/target"
    # Those of the tests, too, which can then be built without a network.
    say "fetching the Rust packages that are missing"
    cargo_here fetch --target "$(rustc -vV | sed -n 's/^host: //p')" ||
        say "not all packages could be fetched (message above)"
    say "building the FMU's library: target/fmu/release"
    cargo_here build --release --lib --no-default-features --target-dir "$REPOSITORY/target/fmu"
    say "building the command line: target/release/iwan"
    cargo_here build --release --features importer --bin iwan
}

cargo_here() {
    (cd "$REPOSITORY" && cargo "$1" --locked ${loudness[@]+"${loudness[@]}"} "${@:2}" >&2)
}

require_tools
prepare_python
point_to_libclang
build
say "ready"
