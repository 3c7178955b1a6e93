# Sourced by the tests beside it, which are given the folders of the source and of the build.
set -euo pipefail
source=$1 build=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "$(basename "$0"): $*" >&2; exit 1; }

# says PATTERN COMMAND...: the command succeeds and its output has a line like that.
says() {
  local pattern=$1 out
  shift
  out=$("$@" 2>&1) || fail "'$*' failed: $out"
  grep -qE "$pattern" <<<"$out" || fail "'$*' says '$out', expected '$pattern'"
}

# build_project FOLDER NAME INSTALLED [OPTION...]: a project that finds gapscope below INSTALLED, into $work/NAME; of
# its programs the one that $only names, or all.
build_project() {
  { cmake -S "$1" -B "$work/$2" -DCMAKE_PREFIX_PATH="$3" "${@:4}" &&
    cmake --build "$work/$2" -j 2 ${only:+--target "$only"}; } >"$work/$2.log" 2>&1 || fail "$2: $(cat "$work/$2.log")"
}
