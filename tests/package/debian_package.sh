#!/usr/bin/env bash
# debian_package.sh SOURCE BUILD: makes the Debian packages, unpacks them into a folder of their own and works there.
source "$(dirname "$0")/expect.sh"
for tool in dpkg-deb dpkg-shlibdeps file; do
  command -v "$tool" >/dev/null || { echo "skipped: no $tool here"; exit 77; }
done

cpack --config "$build/CPackConfig.cmake" -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip -B "$work" >"$work/cpack.log" 2>&1 || fail "cpack: $(cat "$work/cpack.log")"
for package in "$work"/*.deb; do dpkg-deb -x "$package" "$work/unpacked"; done
usr=$work/unpacked/usr

# Whatever it was linked against here is here: every dependency that was found has to be installed.
depends=$(dpkg-deb -f "$work"/gapscope_*.deb Depends)
grep -qE 'libc6 .*libopencv-core|libopencv-core.*libc6' <<<"$depends" || fail "depends on '$depends' only"
for name in $(tr ',' '\n' <<<"$depends" | sed -E 's/^ *([^ |]+).*/\1/'); do
  dpkg-query -W "$name" >/dev/null 2>&1 || fail "depends on $name, which is not installed"
done

says '^gapscope [0-9]' "$usr/bin/gapscope" --version
says '^model-free +22\.[0-9]+ mrad' "$usr/bin/gapscope" detect "$usr/share/doc/gapscope/examples/03_recording.yaml" \
  -o "$work/report"
[ -s "$work/report/overview.png" ] || fail "the report has no figure"
for file in man/man1/gapscope.1 bash-completion/completions/gapscope zsh/vendor-completions/_gapscope; do
  grep -q diagnose "$usr/share/$file" || fail "share/$file does not know diagnose"
done
only=export_drive build_project "$usr/share/doc/libgapscope-dev/examples" example "$usr"
(cd "$work" && says '^drive_.*\.h: [0-9]+ bytes' "$work/example/export_drive" "$usr/share/doc/gapscope/examples/02_experiment.yaml")
