#!/usr/bin/env bash
# Tests that the package which `cargo package` makes is whole: the unpacked crate compiles with all its targets
# (`check`, the default), or passes its tests as well (`test`, which takes some minutes).
set -euo pipefail
cd "$(dirname "$0")/.."
case ${1:-check} in
  check) run=(check --all-targets) ;;
  test) run=(test --no-fail-fast) ;;
  *) echo "usage: tests/package.sh [check|test]" >&2; exit 2 ;;
esac
# The unpacked crate takes the compiled dependencies from here.
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}
cargo package --quiet --locked --no-verify --allow-dirty
package=$(ls -t "$CARGO_TARGET_DIR"/package/ringroad-*.crate | head -n 1)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tar -xzf "$package" -C "$work" --strip-components 1
(cd "$work" && cargo "${run[@]}" --locked)
echo "1 passed (the package: $(tar -tzf "$package" | wc -l) files, $(du -k "$package" | cut -f 1) kB)"
