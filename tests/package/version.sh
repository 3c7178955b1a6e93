#!/usr/bin/env bash
# version.sh SOURCE BUILD: what a build calls itself in a tarball, a clone without tags, at a release, behind it, changed.
source "$(dirname "$0")/expect.sh"
command -v git >/dev/null || { echo "skipped: no git here"; exit 77; }

cd "$work"
export GIT_CONFIG_GLOBAL=/dev/null GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b
written() {
  cmake -DSOURCE="$work/tree" -DRELEASE=1.2.3 -DOUT="$work/version.cpp" -P "$source/src/base/version.cmake" && cat "$work/version.cpp"
}
commit() { git -C tree add -A && git -C tree commit -qm "$1"; }

mkdir tree && echo 1 >tree/file
says '"1\.2\.3"' written
git -C tree init -q
says '"1\.2\.3"' written
commit first
says '"1\.2\.3\+g[0-9a-f]{8}"' written
git -C tree tag v1.2.3
says '"1\.2\.3"' written
before=$(stat -c %y version.cpp)
written >/dev/null
[ "$before" = "$(stat -c %y version.cpp)" ] || fail "written anew without a change"
echo 2 >tree/file
says '"1\.2\.3-dirty"' written
commit second
says '"1\.2\.3-1-g[0-9a-f]{8}"' written
git clone -q --depth 1 "file://$work/tree" shallow && mv tree whole && mv shallow tree
says '"1\.2\.3\+g[0-9a-f]{8}"' written
