#!/usr/bin/env bash
# Installs what is missing, and only that: `setup.sh build` for the page and the command, `setup.sh test` for the
# tests as well. Needs rustup and Node. On Debian the rest comes by itself; elsewhere this says what to install.
set -euo pipefail
cd "$(dirname "$0")/.."
export PATH="${CARGO_HOME:-$HOME/.cargo}/bin:$PATH"

purpose=${1:-build}
case $purpose in
  build | test) ;;
  *) echo "usage: scripts/setup.sh [build|test]" >&2; exit 2 ;;
esac

have() { command -v "$1" >/dev/null 2>&1; }
fail() { printf 'setup: %s\n' "$@" >&2; exit 1; }
# The value of the first line `NAME = "VALUE"` in Cargo.toml, without a leading `=`.
cargo_toml() { sed -nE "s/^$1 = \"=?([^\"]*)\".*/\1/p" Cargo.toml | head -n 1; }
# at_least WANTED GIVEN: whether version GIVEN is WANTED or newer.
at_least() { [ "$(printf '%s\n%s\n' "$1" "$2" | sort -V | head -n 1)" = "$1" ]; }

rust_wanted=$(cargo_toml rust-version)
bindgen_wanted=$(cargo_toml wasm-bindgen)
pack_wanted=0.15.1 # older ones were not tried
if [ -z "$rust_wanted" ] || [ -z "$bindgen_wanted" ]; then
  fail 'Cargo.toml names no rust-version or no exact wasm-bindgen version'
fi

rust_version() { rustc --version 2>/dev/null | cut -d ' ' -f 2 | cut -d - -f 1; }
has_rust() { have cargo && at_least "$rust_wanted" "$(rust_version)"; }
has_wasm_target() { [ -d "$(rustc --print sysroot 2>/dev/null)/lib/rustlib/wasm32-unknown-unknown/lib" ]; }
has_component() { cargo "$1" --version >/dev/null 2>&1; }
has_bindgen() { [ "$(wasm-bindgen --version 2>/dev/null)" = "wasm-bindgen $bindgen_wanted" ]; }
has_pack() { at_least "$pack_wanted" "$(wasm-pack --version 2>/dev/null | cut -d ' ' -f 2)"; }
has_venv() { have python3 && python3 -c 'import ensurepip, venv' 2>/dev/null; }
# Vite's own demand.
has_node() {
  have npm && node -e '
    const [major, minor] = process.versions.node.split(".").map(Number)
    process.exit(major > 22 || (major === 22 && minor >= 12) || (major === 20 && minor >= 19) ? 0 : 1)' 2>/dev/null
}

# ---- what the Debian packages bring ----

# Fills `packages` with the Debian packages that are missing now. It is called anew whenever the answer matters,
# because an installation changes it.
packages=()
find_missing_packages() {
  packages=()
  have cc || packages+=(build-essential) # the linker, and what build scripts compile
  if [ "$purpose" = test ]; then
    [ -x "${CHROMIUM:-/usr/bin/chromium}" ] || packages+=(chromium)
    [ -x "${CHROMEDRIVER:-/usr/bin/chromedriver}" ] || packages+=(chromium-driver)
    [ -x .venv/bin/python ] || has_venv || packages+=(python3-venv)
  fi
}

os_release=${OS_RELEASE:-/etc/os-release} # the test of this script names another one
debian() {
  # shellcheck source=/dev/null
  have apt-get && [ -r "$os_release" ] && (. "$os_release" && [[ " ${ID:-} ${ID_LIKE:-} " == *" debian "* ]])
}

list_and_fail() {
  {
    echo "setup: this is not Debian, so nothing is installed here. Please install:"
    [ ${#packages[@]} -eq 0 ] || printf '  - what Debian calls %s\n' "${packages[@]}"
    has_node || echo "  - Node 20.19, 22.12 or newer, with npm"
    has_rust || echo "  - Rust $rust_wanted or newer, by rustup"
    has_wasm_target || echo "  - rustup target add wasm32-unknown-unknown"
    if [ "$purpose" = test ]; then
      has_component fmt || echo "  - rustup component add rustfmt"
      has_component clippy || echo "  - rustup component add clippy"
    fi
    has_bindgen || echo "  - cargo install wasm-bindgen-cli --version $bindgen_wanted --locked"
    has_pack || echo "  - cargo install wasm-pack --locked"
    [ "$purpose" = build ] || echo "  (CHROMIUM and CHROMEDRIVER name the browser and its driver, if they are elsewhere)"
  } >&2
  exit 1
}

complete() {
  find_missing_packages
  [ ${#packages[@]} -eq 0 ] && has_node && has_rust && has_wasm_target && has_bindgen && has_pack &&
    { [ "$purpose" = build ] || { has_component fmt && has_component clippy; }; }
}

complete && exit 0
debian || list_and_fail

if ! has_node; then
  fail "Node 20.19, 22.12 or newer, with npm, is needed (found: $(node --version 2>/dev/null || echo none))"
fi

if [ ${#packages[@]} -gt 0 ]; then
  as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    have sudo || fail "root (or sudo) is needed for: apt-get install ${packages[*]}"
    as_root=(sudo)
  fi
  echo "setup: apt-get install ${packages[*]}"
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${packages[@]}"
  # The packages are there, but a browser of one's own choice (CHROMIUM, CHROMEDRIVER) may be named wrongly.
  find_missing_packages
  [ ${#packages[@]} -eq 0 ] || fail "apt-get installed what was asked, but this is still missing: ${packages[*]}" \
    "CHROMIUM and CHROMEDRIVER, where they are set, must name programs that exist"
fi

# ---- what Rust's own tools bring ----

# With the versions that its authors locked; where a mirror lacks one of them, with the newest that fit.
# Not in the project's own target folder, which the Makefile names.
install() {
  (
    unset CARGO_TARGET_DIR
    cargo install "$@" --locked --force || cargo install "$@" --force
  )
}

if ! has_rust; then
  have rustup || fail "Rust $rust_wanted or newer is needed: install rustup (https://rustup.rs)"
  toolchain=$(sed -nE 's/^channel = "(.*)"/\1/p' rust-toolchain.toml)
  echo "setup: Rust $toolchain"
  rustup toolchain install "$toolchain" --profile minimal
  has_rust || fail "Rust $rust_wanted or newer is needed, and $(rust_version) is active: rustup show tells why"
fi
has_wasm_target || rustup target add wasm32-unknown-unknown
if [ "$purpose" = test ]; then
  has_component fmt || rustup component add rustfmt
  has_component clippy || rustup component add clippy
fi
if ! has_bindgen; then
  echo "setup: wasm-bindgen $bindgen_wanted"
  install wasm-bindgen-cli --version "$bindgen_wanted"
fi
if ! has_pack; then
  echo "setup: wasm-pack"
  install wasm-pack
fi
complete || fail "something is still missing; this should not happen: bash -x scripts/setup.sh $purpose shows it"
