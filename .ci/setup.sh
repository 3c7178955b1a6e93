# Sourced by the commands beside it: installs what is missing, builds.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

say() { printf '\n== %s\n' "$*"; }

# Installs the Debian packages that are not there yet; asks for nothing when all are.
install_packages() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
  done
  [ ${#missing[@]} -gt 0 ] || { say "All ${#} Debian packages are installed."; return 0; }
  say "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "needs root or sudo to install: ${missing[*]}" >&2; exit 1; }
    root=(sudo)
  fi
  "${root[@]}" apt-get update -qq
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# build FOLDER TARGETS [CMAKE-OPTION...]: a module at once, since the headers take longest; who works on them
# has every file apart.
build() {
  local folder=$1 targets=$2
  shift 2
  say "Building $targets in $folder ($(nproc) jobs)"
  cmake -S . -B "$folder" -G Ninja -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 "$@" >"$folder.configure.log" 2>&1 ||
    { cat "$folder.configure.log" >&2; rm -f "$folder.configure.log"; exit 1; }
  rm -f "$folder.configure.log"
  cmake --build "$folder" --target $targets
}

mapfile -t packages <.ci/packages            # to build and to run gapscope
mapfile -t test_packages <.ci/test_packages  # for the tests, besides
python_packages=(pybind11-dev python3-dev python3-numpy)  # for the Python package, besides
benchmark_packages=(libbenchmark-dev libboost-dev libsundials-dev)  # what the simulator is compared with
