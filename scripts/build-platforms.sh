#!/usr/bin/env bash
# The FMU's library for every platform, each run and compared where it can be run, and one archive
# that holds them all.
#
#   scripts/build-platforms.sh [--install] [--joint JOINT.json] [--output JOINT.fmu] [PLATFORM…]
#   scripts/build-platforms.sh --check
#
#   PLATFORM    linux64 (glibc 2.17 or newer), win64, aarch64-linux; by default all three
#   --install   fetch the system's missing packages with apt-get (Debian and its kin, as root)
#   --joint     the joint of the archive; by default the one with causes of scripts/platforms
#   --output    the archive; by default target/platforms/joint.fmu
#   --check     build nothing: run what was built of these sources, and for linux64 else the library
#               that this machine uses itself; a step of the tests
#
# Libraries go to target/platforms/PLATFORM/. What cannot be built or run on this machine is said
# in the table at the end and left out of the archive; a platform asked for by name must be built.
# Exit status 0: everything that was tried succeeded; 1: a build failed or a platform answers
# differently; 2: usage, a named platform lacks its tools, or a machine other than Linux on x86-64;
# 4: with --check, where a platform was not run, on such a machine none, which a line `NOT RUN` tells.
#
# Rust's standard library for a platform comes from rustup; where rustup can fetch nothing, Debian's
# packages of the compiler and its sources are unpacked into target/platforms and the standard
# library is built with it.
set -euo pipefail

install=no
check=no
joint=
output=
asked=()
while [ $# -gt 0 ]; do
    case "$1" in
    --install) install=yes ;;
    --check) check=yes ;;
    --joint | --output)
        [ $# -ge 2 ] || { echo "build-platforms: $1 needs a file" >&2; exit 2; }
        if [ "$1" = --output ]; then
            output=$(realpath -m "$2")
        elif [ -e "$2" ]; then
            joint=$(realpath "$2")
        else
            echo "build-platforms: --joint: expected a file, there is no $2" >&2
            exit 2
        fi
        shift
        ;;
    linux64 | win64 | aarch64-linux) asked+=("$1") ;;
    *)
        echo "usage: scripts/build-platforms.sh [--check] [--install] [--joint FILE] [--output FILE] [linux64|win64|aarch64-linux]…" >&2
        exit 2
        ;;
    esac
    shift
done

source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"
cd "$REPOSITORY"
tools="$REPOSITORY/scripts/platforms"
out="$REPOSITORY/target/platforms"
joint=${joint:-"$tools/causes.json"}
output=${output:-"$out/joint.fmu"}
mkdir -p "$out"
machine=$(uname -s)-$(uname -m)
if [ "$machine" != Linux-x86_64 ]; then
    if [ "$check" = yes ]; then
        echo "NOT RUN: linux64 win64 aarch64-linux: written for Linux on x86-64, this is $machine"
        exit 4
    fi
    stop "written for Linux on x86-64; elsewhere: cargo rustc --release --lib --crate-type cdylib --no-default-features --target TRIPLE, then iwan export --binary PLATFORM=FILE"
fi

declare -A triple=(
    [linux64]=x86_64-unknown-linux-gnu
    [win64]=x86_64-pc-windows-gnu
    [aarch64-linux]=aarch64-unknown-linux-gnu
)
declare -A built_as=([linux64]=libiwan.so [win64]=iwan.dll [aarch64-linux]=libiwan.so)
declare -A packed_as=([linux64]=IwanJoint.so [win64]=IwanJoint.dll [aarch64-linux]=IwanJoint.so)
declare -A built ran library_of
zig="$out/zig"

have() { command -v "$1" >/dev/null; }

# Debian puts wine64 beside the path where its package `wine` is not installed too.
wine64_program() {
    command -v wine64 || { [ -x /usr/lib/wine/wine64 ] && echo /usr/lib/wine/wine64; }
}

# Packages that a platform still lacks, by Debian's names; nothing where all is there.
lacks() {
    case "$1" in
    win64)
        have x86_64-w64-mingw32-gcc || echo gcc-mingw-w64-x86-64-win32
        wine64_program >/dev/null || echo wine64
        ;;
    aarch64-linux)
        have qemu-aarch64 || echo qemu-user
        [ -e /usr/aarch64-linux-gnu/lib/ld-linux-aarch64.so.1 ] || echo libc6-arm64-cross
        ;;
    esac
}

fetch_packages() {
    local missing=()
    local platform
    for platform in "$@"; do
        # shellcheck disable=SC2207 # names of packages have no spaces
        missing+=($(lacks "$platform"))
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    if [ "$install" = no ]; then
        say "not on this machine: ${missing[*]} (--install fetches them with apt-get)"
        return 0
    fi
    have apt-get || stop "--install needs apt-get"
    say "apt-get install ${missing[*]}"
    { apt-get update && apt-get install -y --no-install-recommends "${missing[@]}"; } \
        >"$out/apt.log" 2>&1 || say "apt-get failed, see target/platforms/apt.log"
}

# zig links against an old glibc and for ARM; from PyPI, in an environment of its own.
prepare_zig() {
    [ -x "$zig/bin/cargo-zigbuild" ] && return 0
    say "fetching zig (about 100 MB)"
    python3 -m venv "$zig" &&
        "$zig/bin/python" -m pip install --quiet --disable-pip-version-check \
            --requirement "$tools/requirements.txt" >&2
}

# Debian's compiler of one version with the sources of its standard library, unpacked, not installed.
prepare_sources() {
    compiler="$out/rustc"
    [ -x "$compiler" ] && "$compiler" --version >/dev/null 2>&1 && return 0
    have apt-get && have dpkg || return 1
    say "unpacking Debian's rustc-web and rust-web-src (about 120 MB)"
    local root="$out/debian" version
    mkdir -p "$root"
    apt-get update >"$out/apt.log" 2>&1 || true
    version=$(apt-cache depends rustc-web libstd-rust-web-dev 2>/dev/null |
        sed -n 's/.*Depends: \(libstd-rust-web-[0-9.]*\)$/\1/p' | head -1)
    [ -n "$version" ] || return 1
    local llvm
    llvm=$(apt-cache depends "$version" | sed -n 's/.*Depends: \(libllvm[0-9]*\)$/\1/p' | head -1)
    (
        cd "$root"
        rm -f -- *.deb
        apt-get download rustc-web libstd-rust-web-dev rust-web-src "$version" "$llvm" >>"$out/apt.log" 2>&1
        for package in *.deb; do dpkg -x "$package" .; done
        rm -f -- *.deb
    ) || return 1
    cat >"$compiler" <<END
#!/bin/sh
root=\$(dirname "\$0")/debian
export LD_LIBRARY_PATH="\$root/usr/lib/x86_64-linux-gnu:\$root/usr/lib/llvm-${llvm#libllvm}/lib"
exec "\$root/usr/bin/rustc" "\$@"
END
    chmod +x "$compiler"
    "$compiler" --version >&2
}

# Sets `standard` to what cargo needs for the platform's standard library.
standard_library() {
    local target=${triple[$1]}
    standard=()
    unset RUSTC RUSTC_BOOTSTRAP
    [ "${IWAN_STANDARD_LIBRARY:-rustup}" = sources ] || {
        [ -d "$(rustc --print target-libdir --target "$target" 2>/dev/null)" ] && return 0
        have rustup && rustup target add "$target" >"$out/rustup.log" 2>&1 && return 0
    }
    prepare_sources || return 1
    export RUSTC="$compiler" RUSTC_BOOTSTRAP=1
    standard=(-Zbuild-std=std,panic_unwind)
}

# One platform's library. Link-time optimisation over everything drops what the standard library
# imports and the joint never calls: on Windows bcryptprimitives.dll, which older systems lack.
build_platform() {
    local platform=$1 target=${triple[$1]} command=(cargo rustc) linker_target
    standard_library "$platform" || { built[$platform]="no: no standard library for $target"; return 1; }
    linker_target=$target
    if [ "$platform" = win64 ]; then
        have x86_64-w64-mingw32-gcc || { built[$platform]="no: mingw-w64 is missing"; return 1; }
        export CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER=x86_64-w64-mingw32-gcc
    else
        prepare_zig || { built[$platform]="no: zig could not be fetched"; return 1; }
        command=("$zig/bin/cargo-zigbuild" rustc)
        linker_target=$target.2.17
    fi
    say "building $platform"
    # No path of this machine may stay in what is shipped.
    local separator=$'\x1f' sysroot
    sysroot=$("${RUSTC:-rustc}" --print sysroot)
    if ! PATH="$zig/bin:$PATH" CARGO_PROFILE_RELEASE_LTO=fat CARGO_PROFILE_RELEASE_CODEGEN_UNITS=1 \
        CARGO_PROFILE_RELEASE_STRIP=symbols CARGO_TARGET_DIR="$out/build" \
        CARGO_ENCODED_RUSTFLAGS="--remap-path-prefix=$REPOSITORY=iwan${separator}--remap-path-prefix=${CARGO_HOME:-$HOME/.cargo}=cargo${separator}--remap-path-prefix=$sysroot=rust" \
        "${command[@]}" --locked ${standard[@]+"${standard[@]}"} --target "$linker_target" --release --lib \
        --crate-type cdylib --no-default-features >"$out/$platform.log" 2>&1; then
        tail -5 "$out/$platform.log" >&2
        built[$platform]="FAILED, see target/platforms/$platform.log"
        return 1
    fi
    library_of[$platform]="$out/$platform/${packed_as[$platform]}"
    mkdir -p "$out/$platform"
    cp "$out/build/$target/release/${built_as[$platform]}" "${library_of[$platform]}"
    inspect "$platform"
}

# What a library needs and shows.
inspect() {
    built[$1]=$("$PYTHON" "$tools/library.py" "$1" "${library_of[$1]}" "${@:2}") ||
        { built[$1]="FAILED: ${built[$1]}"; return 1; }
}

# The library that an earlier run built, where it is of these sources. For linux64 else the one of
# this machine: as it is linked here it is not meant for others.
find_platform() {
    local stamp library="$out/$1/${packed_as[$1]}"
    stamp=$(grep -aom1 'iwan-sources-[0-9a-f]\{16\}' "$FMU_LIBRARY") || true
    # An empty stamp would be found in any library.
    [ -n "$stamp" ] || { built[$1]="FAILED: $FMU_LIBRARY has no stamp"; return 1; }
    if [ -e "$library" ] && grep -aqF "$stamp" "$library"; then
        library_of[$1]=$library
        inspect "$1"
    elif [ "$1" = linux64 ]; then
        library_of[linux64]=$FMU_LIBRARY
        inspect linux64 --here
    else
        built[$1]="no: scripts/build-platforms.sh $1 has not been run on these sources"
        return 1
    fi
}

# Joints without causes and with all of them, both drives, each step ending at a value or following
# the input's derivatives, or ending at a value under the functions of FMI 3.0: JOINT DRIVE WAY.
cases=()
for joint_of_case in exact causes; do
    for drive in force displacement; do
        for way in values slopes three; do cases+=("$joint_of_case $drive $way"); done
    done
done
declare -A guid_of
declare -A reference_of=([force]=0 [displacement]=1)

# Archives, resources, loads and what `iwan simulate` answers.
prepare_cases() {
    local name drive place
    for drive in force displacement; do
        rows=$("$PYTHON" "$tools/load.py" write "$drive" "$out/$drive.txt" "$out/$drive.csv")
        for name in exact causes; do
            place="$out/$name-$drive"
            "$IWAN" export "$tools/$name.json" --drive "$drive" -o "$place.fmu" "$@" 2>/dev/null
            "$IWAN" export "$tools/$name.json" --drive "$drive" --fmi 3 -o "$place-3.fmu" "$@" 2>/dev/null
            guid_of[$name-$drive]=$("$PYTHON" -c 'import fmpy, sys; print(fmpy.read_model_description(sys.argv[1]).guid)' "$place.fmu")
            "$IWAN" simulate "$tools/$name.json" "$out/$drive.csv" --drive "$drive" -o "$place.csv" 2>/dev/null
            mkdir -p "$out/resources/$name"
            cp "$tools/$name.json" "$out/resources/$name/joint.json"
        done
    done
}

# Sets `runner` to what runs a program of a platform, `host` to the program of FMI 2.0, `host3` to that
# of FMI 3.0, and `root` to what stands before a path; status 1 where this machine lacks something.
prepare_host() {
    local platform=$1 suffix= compiler=(cc) libraries=(-ldl)
    runner=() root=
    case "$platform" in
    linux64) ;;
    win64)
        runner=("$(wine64_program)") || { ran[$platform]="not run here: wine64 is missing"; return 1; }
        suffix=.exe root="Z:" compiler=(x86_64-w64-mingw32-gcc) libraries=()
        export WINEPREFIX="$out/wine" WINEDEBUG=-all DISPLAY=
        ;;
    aarch64-linux)
        have qemu-aarch64 || { ran[$platform]="not run here: qemu-user is missing"; return 1; }
        [ -e /usr/aarch64-linux-gnu/lib/ld-linux-aarch64.so.1 ] ||
            { ran[$platform]="not run here: libc6-arm64-cross is missing"; return 1; }
        runner=(qemu-aarch64 -L /usr/aarch64-linux-gnu)
        compiler=("$zig/bin/python" -m ziglang cc -target aarch64-linux-gnu.2.17)
        ;;
    esac
    host="$out/host-$platform$suffix" host3="$out/host3-$platform$suffix"
    "${compiler[@]}" -O1 -o "$host" "$tools/host.c" ${libraries[@]+"${libraries[@]}"}
    "${compiler[@]}" -O1 -o "$host3" "$tools/host3.c" ${libraries[@]+"${libraries[@]}"}
}

# The host of a platform, run on its library in every case; answers go to target/platforms/PLATFORM/.
# linux64 is held against `iwan simulate` and, in the whole archive, fmpy, and in FMI 3.0 against
# itself in FMI 2.0; the others against linux64.
run_platform() {
    local platform=$1 library=${library_of[$1]} runner host host3 program root name drive way answers found by passed=0
    prepare_host "$platform" || return 0
    [ "$platform" = linux64 ] || [ -d "$out/answers/linux64" ] ||
        { ran[$platform]="not run: compared with linux64, which was not asked for"; return 0; }
    mkdir -p "$out/answers/$platform"
    for case in "${cases[@]}"; do
        read -r name drive way <<<"$case"
        answers="$out/answers/$platform/$name-$drive-$way.txt"
        program=("$host")
        [ "$way" != three ] || program=("$host3")
        program+=("$root$library" "$root$out/resources/$name" "${guid_of[$name-$drive]}" "${reference_of[$drive]}")
        program+=("$out/$drive.txt" "$rows")
        [ "$way" = three ] || program+=("$way")
        if ! ${runner[@]+"${runner[@]}"} "${program[@]}" >"$answers" 2>"$out/$platform-run.log"; then
            tail -3 "$out/$platform-run.log" >&2
            ran[$platform]="FAILED ($case), see target/platforms/$platform-run.log"
            return 1
        fi
        # wine's C library ends lines as Windows does.
        sed -i 's/\r$//' "$answers"
        if [ "$platform" != linux64 ]; then
            by="${runner[0]##*/}, against linux64"
            found=$("$PYTHON" "$tools/load.py" compare "$out/answers/linux64/$name-$drive-$way.txt" "$answers")
        elif [ "$way" = three ]; then
            found=$("$PYTHON" "$tools/load.py" compare "${answers%-three.txt}-values.txt" "$answers")
        elif [ "$way" = values ]; then
            by="hosts in C, against iwan simulate and fmpy"
            found=$("$PYTHON" "$tools/load.py" against "$out/$name-$drive.csv" "$answers") && found=$(in_fmpy)
        else
            found=$(in_fmpy)
        fi || { ran[$platform]="FAILED under $by ($case): $found"; return 1; }
        passed=$((passed + 1))
    done
    ran[$platform]="run by $by: $passed loads of $((rows - 1)) steps, FMI 2.0 and 3.0, 7 signals, bit-identical"
}

# The whole archive of a case in fmpy, against the host's answers.
in_fmpy() {
    "$PYTHON" "$tools/in_fmpy.py" "$out/$name-$drive.fmu" "$out/$drive.txt" "$way" "$answers.fmpy" &&
        "$PYTHON" "$tools/load.py" compare "$answers" "$answers.fmpy"
}

# The archives of all that was built, by `iwan check`, which loads them through a crate of others.
check_archives() {
    local name drive version count=0
    for name in exact causes; do
        for drive in force displacement; do
            for version in "" -3; do
                "$IWAN" check "$out/$name-$drive$version.fmu" "$out/$name-$drive.csv" >"$out/check.log" 2>&1 ||
                    { checked="FAILED ($name-$drive$version), see target/platforms/check.log"; return 1; }
                count=$((count + 1))
            done
        done
    done
    checked="iwan check: $count archives of FMI 2.0 and 3.0 of ${#binaries[@]} libraries, no fault"
}

platforms=(linux64 win64 aarch64-linux)
[ ${#asked[@]} -eq 0 ] || platforms=("${asked[@]}")
prepare=build_platform
if [ "$check" = yes ]; then
    prepare=find_platform
else
    fetch_packages "${platforms[@]}"
fi
failed=no
binaries=()
for platform in "${platforms[@]}"; do
    if "$prepare" "$platform"; then
        binaries+=("--binary=$platform=${library_of[$platform]}")
    elif [[ "${built[$platform]}" == FAILED* ]]; then
        failed=yes
    fi
done

checked="not run"
if [ ${#binaries[@]} -gt 0 ]; then
    rm -rf "$out/answers"
    prepare_cases "${binaries[@]}"
    for platform in "${platforms[@]}"; do
        [[ "${built[$platform]}" != no* && "${built[$platform]}" != FAILED* ]] || continue
        run_platform "$platform" || failed=yes
    done
    "$IWAN" export "$joint" -o "$output" "${binaries[@]}" 2>/dev/null
    check_archives || failed=yes
fi

printf '\n%-14s  %s\n' platform "what was built, and what was run"
for platform in "${platforms[@]}"; do
    printf '%-14s  built: %s\n%-14s  %s\n' "$platform" "${built[$platform]-}" "" "${ran[$platform]-not run}"
done
echo "archive         $checked"
echo "darwin64        not built here and never run: build it on a Mac and add it with --binary darwin64=FILE"
[ ${#binaries[@]} -eq 0 ] || printf '\narchive of all that was built: %s\n' "${output#"$REPOSITORY/"}"
[ "$failed" = no ] || exit 1
if [ "$check" = yes ]; then
    status=0
    for platform in "${platforms[@]}"; do
        [[ "${ran[$platform]-}" == run* ]] && continue
        echo "NOT RUN: $platform: ${ran[$platform]-${built[$platform]}}"
        status=4
    done
    exit "$status"
fi
for platform in ${asked[@]+"${asked[@]}"}; do
    [[ "${built[$platform]}" != no* ]] || exit 2
done
