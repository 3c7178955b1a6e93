#!/usr/bin/env bash
# install_tree.sh SOURCE BUILD: installs the build into a folder of its own, builds docs/example against that and
# runs it; then a project that includes every installed header and links all libraries.
source "$(dirname "$0")/expect.sh"

cmake --install "$build" --prefix "$work/tree" >/dev/null
says '^gapscope [0-9]' "$work/tree/bin/gapscope" --version
cmp "$work/tree/share/gapscope/schemas/result.schema.json" <("$work/tree/bin/gapscope" schema result) || fail "other schemas"

# Without export_drive the examples ask for the estimators, which need no library for figures, files, stores or hashes.
build_project "$source/docs/example" example "$work/tree" -DEXPORT=OFF -DCMAKE_DISABLE_FIND_PACKAGE_OpenCV=ON \
  -DCMAKE_DISABLE_FIND_PACKAGE_PNG=ON -DCMAKE_DISABLE_FIND_PACKAGE_yaml-cpp=ON -DCMAKE_DISABLE_FIND_PACKAGE_tinyxml2=ON -DCMAKE_DISABLE_FIND_PACKAGE_OpenSSL=ON
says '^6927 samples' "$work/example/read_drive" "$source/configs/03_recording.csv"
says ' good enough for a gap' "$work/example/check_drive" "$source/configs/03_recording.csv"
says '^verdict backlash, gap 2[123]\.' "$work/example/stream_gap" "$source/configs/03_recording.csv"
says '^gap 20\.0 mrad' "$work/example/close_loop"
says '^gap 2[123]\.[0-9]+ mrad' "$work/example/measure_gap" "$source/configs/03_recording.csv"
says '^gap \[rad\] .* 0\.021[789]' "$work/example/fit_drive" "$source/configs/03_recording.csv"
says '12000 samples' "$work/example/simulate_drive" "$work/drive.csv"
head -n 3001 "$work/drive.csv" >"$work/first_seconds.csv"
says '^  added: [a-z_]+$' "$work/example/diagnose_drive" "$work/first_seconds.csv"
awk 'BEGIN { print "t,u,x1"; for (i = 0; i < 100; ++i) print i / 1000 ",0,0" }' >"$work/rest.csv"
says '^inconclusive: .+' "$work/example/measure_gap" "$work/rest.csv"

mkdir "$work/everything"
(cd "$work/tree/include" && find gapscope -name '*.h' | sort | sed 's/.*/#include <&>/') >"$work/everything/main.cpp"
cat >>"$work/everything/main.cpp" <<'END'
int main(int argc, char** argv) {
  if (argc > 1) gapscope::export_drive(argv[1], gapscope::ExportFormat::kC);  // the uppermost library with a header
}
END
cat >"$work/everything/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.22)
project(everything LANGUAGES CXX)
find_package(gapscope 0.2 REQUIRED)
add_executable(everything main.cpp)
target_link_libraries(everything PRIVATE gapscope::gapscope)
END
build_project "$work/everything" all "$work/tree"
"$work/all/everything"
