#!/usr/bin/env bash
# Tests scripts/setup.sh without installing anything. Each case makes a small machine in a temporary folder: a PATH
# with a few basic tools, a copy of the script with the files that it reads, and stand-ins for apt-get, sudo, rustup,
# cargo, rustc, node and so on. A stand-in puts the files in place that the real program would put there.
set -euo pipefail
repository=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
bash=$(command -v bash)
rust=$(sed -nE 's/^rust-version = "(.*)"/\1.0/p' "$repository/Cargo.toml")
bindgen=$(sed -nE 's/^wasm-bindgen = "=(.*)"/\1/p' "$repository/Cargo.toml")

# One file for all stand-ins; which one it is tells the name under which it was called. MACHINE is set by `setup`.
write_stand_in() {
  echo "#!$bash"
  cat <<'STAND_IN'
set -eu
name=${0##*/}
place() { mkdir -p "${1%/*}"; cp "$MACHINE/stand-in" "$1"; } # place FILE: makes FILE a program
version() { if [ -e "$MACHINE/version/$1" ]; then cat "$MACHINE/version/$1"; fi; }
log() { echo "$name $*" >>"$MACHINE/log"; }
case "$name $*" in
  "apt-get update"*) log update ;;
  "apt-get install"*)
    shift
    [ ! -e "$MACHINE/no-network" ] || { echo "E: Unable to fetch some archives" >&2; exit 100; }
    for package in "$@"; do
      case $package in
        -*) continue ;;
        build-essential) place "$MACHINE/bin/cc" ;;
        chromium) place "$MACHINE/usr/bin/chromium" ;;
        chromium-driver) place "$MACHINE/usr/bin/chromedriver" ;;
        python3-venv) place "$MACHINE/bin/python3"; touch "$MACHINE/venv" ;;
        *) echo "E: Unable to locate package $package" >&2; exit 100 ;;
      esac
      log install "$package"
    done ;;
  "sudo "*) log run; UNPRIVILEGED='' exec "$@" ;;
  "id -u") [ -z "${UNPRIVILEGED:-}" ] && echo 0 || echo 1000 ;;
  "rustup toolchain install "*)
    log toolchain "$3"
    place "$MACHINE/cargo/bin/cargo"; place "$MACHINE/cargo/bin/rustc"
    [ -e "$MACHINE/rust-override" ] || echo "$3" >"$MACHINE/version/rust" ;;
  "rustup target add wasm32-unknown-unknown") log target; mkdir -p "$MACHINE/sysroot/lib/rustlib/wasm32-unknown-unknown/lib" ;;
  "rustup component add rustfmt") log component rustfmt; touch "$MACHINE/fmt" ;;
  "rustup component add clippy") log component clippy; touch "$MACHINE/clippy" ;;
  "rustc --version") echo "rustc $(version rust) (0123456789 2026-01-01)" ;;
  "rustc --print sysroot") echo "$MACHINE/sysroot" ;;
  "cargo fmt --version") [ -e "$MACHINE/fmt" ] ;;
  "cargo clippy --version") [ -e "$MACHINE/clippy" ] ;;
  "cargo install "*)
    log "$@"
    case " $* " in *" --locked "*) [ ! -e "$MACHINE/lock-unknown" ] || exit 101 ;; esac
    case $2 in
      wasm-bindgen-cli) place "$MACHINE/cargo/bin/wasm-bindgen"; echo "$4" >"$MACHINE/version/bindgen" ;;
      wasm-pack) place "$MACHINE/cargo/bin/wasm-pack"; echo 0.99.0 >"$MACHINE/version/pack" ;;
      *) exit 101 ;;
    esac ;;
  "wasm-bindgen --version") echo "wasm-bindgen $(version bindgen)" ;;
  "wasm-pack --version") echo "wasm-pack $(version pack)" ;;
  "node --version") echo v18.0.0 ;; # shown in a refusal only
  "node -e "*) [ ! -e "$MACHINE/old-node" ] ;;
  "python3 -c "*) [ -e "$MACHINE/venv" ] ;;
  *) echo "the stand-in does not know: $name $*" >&2; exit 99 ;;
esac
STAND_IN
}

# A fresh Debian as the README presumes it: apt-get, Node and rustup are there, and nothing else.
new_machine() {
  MACHINE=$work/$1
  mkdir -p "$MACHINE"/{bin,version,project/scripts,cargo/bin}
  local tool
  for tool in bash cat chmod cp cut dirname env head mkdir sed sort touch; do
    ln -s "$(type -P "$tool")" "$MACHINE/bin/$tool"
  done
  write_stand_in >"$MACHINE/stand-in"
  chmod +x "$MACHINE/stand-in"
  for tool in apt-get id node npm; do cp "$MACHINE/stand-in" "$MACHINE/bin/$tool"; done
  cp "$MACHINE/stand-in" "$MACHINE/cargo/bin/rustup"
  cp "$repository/scripts/setup.sh" "$MACHINE/project/scripts/"
  cp "$repository/Cargo.toml" "$repository/rust-toolchain.toml" "$MACHINE/project/"
  echo 'ID=debian' >"$MACHINE/os-release"
  : >"$MACHINE/log"
}

# setup ARGUMENT…: runs the script on the machine; leaves what it printed in `output` and how it ended in `code`.
setup() {
  code=0
  output=$(env -i MACHINE="$MACHINE" PATH="$MACHINE/bin" HOME="$MACHINE" CARGO_HOME="$MACHINE/cargo" \
    OS_RELEASE="$MACHINE/os-release" UNPRIVILEGED="${UNPRIVILEGED:-}" \
    CHROMIUM="${BROWSER:-$MACHINE/usr/bin/chromium}" CHROMEDRIVER="$MACHINE/usr/bin/chromedriver" \
    "$bash" "$MACHINE/project/scripts/setup.sh" "$@" 2>&1) || code=$?
}

passed=0
wrong() { printf 'case "%s": %s\n--- printed:\n%s\n--- installed:\n%s\n' "$current" "$1" "$output" "$(cat "$MACHINE/log")" >&2; exit 1; }
begin() { current=$1 output=''; new_machine "$passed"; }
end() { passed=$((passed + 1)); }
succeeds() { setup "$@"; [ "$code" -eq 0 ] || wrong "setup $* ended with $code"; }
# refuses CODE TEXT ARGUMENT…: ends with CODE and says TEXT.
refuses() {
  local expected=$1 text=$2; shift 2
  setup "$@"
  [ "$code" -eq "$expected" ] || wrong "setup $* ended with $code, not $expected"
  [[ $output == *"$text"* ]] || wrong "setup $* does not say: $text"
}
installed() { [ "$(cat "$MACHINE/log")" = "$1" ] || wrong "it should have installed: $1"; }
does_nothing() { : >"$MACHINE/log"; succeeds "$@"; installed ''; [ -z "$output" ] || wrong 'it should print nothing'; }

for_build="apt-get update
apt-get install build-essential
rustup toolchain $rust
rustup target
cargo install wasm-bindgen-cli --version $bindgen --locked --force
cargo install wasm-pack --locked --force"

begin 'a fresh machine is set up for a build by one call'
succeeds build; installed "$for_build"; does_nothing build; end

begin 'a fresh machine is set up for the tests by one call'
succeeds test
installed "apt-get update
apt-get install build-essential
apt-get install chromium
apt-get install chromium-driver
apt-get install python3-venv
rustup toolchain $rust
rustup target
rustup component rustfmt
rustup component clippy
cargo install wasm-bindgen-cli --version $bindgen --locked --force
cargo install wasm-pack --locked --force"
does_nothing test; does_nothing build; end

begin 'a machine that can build gets only what the tests need besides'
succeeds build; : >"$MACHINE/log"; succeeds test
installed 'apt-get update
apt-get install chromium
apt-get install chromium-driver
apt-get install python3-venv
rustup component rustfmt
rustup component clippy'
does_nothing test; end

begin 'a machine that lacks Chromium alone gets Chromium alone'
succeeds test; rm "$MACHINE/usr/bin/chromium"; : >"$MACHINE/log"; succeeds test
installed 'apt-get update
apt-get install chromium'
end

begin 'an older wasm-bindgen and an older wasm-pack are replaced'
succeeds build; echo 0.2.1 >"$MACHINE/version/bindgen"; echo 0.9.0 >"$MACHINE/version/pack"; : >"$MACHINE/log"; succeeds build
installed "cargo install wasm-bindgen-cli --version $bindgen --locked --force
cargo install wasm-pack --locked --force"
end

begin 'where the registry lacks a locked version, the newest that fit are taken'
touch "$MACHINE/lock-unknown"; succeeds build
[[ $(cat "$MACHINE/log") == *"wasm-pack --locked --force
cargo install wasm-pack --force" ]] || wrong 'wasm-pack should be installed without its lock'
does_nothing build; end

begin 'packages are installed through sudo by a user without rights'
cp "$MACHINE/stand-in" "$MACHINE/bin/sudo"; UNPRIVILEGED=1 succeeds build
[[ $(cat "$MACHINE/log") == "sudo run
apt-get update
sudo run
apt-get install build-essential"* ]] || wrong 'apt-get should run through sudo'
end

begin 'without rights and without sudo the packages are named'
UNPRIVILEGED=1 refuses 1 'root (or sudo) is needed for: apt-get install build-essential chromium' test; installed ''; end

begin 'where Chromium is named wrongly, the names are mentioned'
BROWSER=/nowhere/chromium refuses 1 'still missing: chromium
setup: CHROMIUM and CHROMEDRIVER, where they are set, must name programs that exist' test
end

begin 'when apt-get fails, setup fails and installs nothing else'
touch "$MACHINE/no-network"; refuses 100 'Unable to fetch' build; installed 'apt-get update'; end

begin 'a system other than Debian gets a list and nothing is installed'
echo 'ID=fedora' >"$MACHINE/os-release"
refuses 1 'this is not Debian' test
for line in 'Debian calls build-essential' 'Debian calls chromium-driver' "Rust ${rust%.0} or newer" \
  'rustup target add wasm32-unknown-unknown' 'rustup component add clippy' \
  "cargo install wasm-bindgen-cli --version $bindgen --locked" 'cargo install wasm-pack --locked'; do
  [[ $output == *"$line"* ]] || wrong "the list lacks: $line"
done
installed ''; end

begin 'an old Node is refused with the versions that will do'
touch "$MACHINE/old-node"
refuses 1 'Node 20.19, 22.12 or newer, with npm, is needed (found: v18.0.0)' build; installed ''; end

begin 'a missing Node is refused'
rm "$MACHINE/bin/node"; refuses 1 'is needed (found: none)' build; installed ''; end

begin 'without rustup its address is given'
rm "$MACHINE/cargo/bin/rustup"; refuses 1 'install rustup (https://rustup.rs)' build; end

begin 'when an older Rust stays active, the command that tells why is given'
touch "$MACHINE/rust-override"; echo 1.70.0 >"$MACHINE/version/rust"
refuses 1 '1.70.0 is active: rustup show tells why' build; end

begin 'an unknown purpose is refused with the usage'
refuses 2 'usage: scripts/setup.sh [build|test]' everything; installed ''; end

echo "$passed passed"
