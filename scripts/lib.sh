# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Shared by the scripts beside it, which have changed to the root of the repository.

fail() {
  echo "error: $1" >&2
  exit 1
}

# need_packages PACKAGE...: installs the Debian packages that are missing. A tool counts as present
# when its command is there, wherever it came from.
need_packages() {
  local package missing=()
  for package in "$@"; do
    case "$package" in
      g++ | cmake | pkg-config) command -v "$package" >/dev/null && continue ;;
      ninja-build) command -v ninja >/dev/null && continue
                   command -v make >/dev/null && continue ;;
    esac
    # Elsewhere than on Debian and Ubuntu, configuring says what is missing.
    command -v dpkg-query >/dev/null || continue
    if ! dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q ' installed$'; then
      missing+=("$package")
    fi
  done
  [ ${#missing[@]} -eq 0 ] || install_packages "${missing[@]}"
}

install_packages() {
  local as_root=() log
  command -v apt-get >/dev/null || fail "these packages are missing: $*"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "these packages are missing and installing them needs root or sudo: $*"
    as_root=(sudo)
  fi
  echo "installing with apt-get: $*"
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update &&
         "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
           apt-get install -y --no-install-recommends "$@"; } </dev/null >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    fail "apt-get could not install: $* (log: $log)"
  fi
  rm -f "$log"
}

# The package of GCC's compiler for GPUs.
offload_compiler() {
  echo "gcc-$(g++ -dumpversion | cut -d . -f 1)-offload-nvptx"
}

# configure PRESET: creates build/PRESET once; later the build itself notices changes.
configure() {
  local dir=build/$1 source generator=()
  if [ -f "$dir/CMakeCache.txt" ]; then
    source=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$dir/CMakeCache.txt")
    # The repository was moved, or is mounted elsewhere: its old build folder is of no use.
    [ "$source" -ef . ] || rm -rf "$dir"
  fi
  if [ -f "$dir/configured" ] && [ ! CMakePresets.json -nt "$dir/configured" ]; then
    return
  fi
  if [ ! -f "$dir/CMakeCache.txt" ] && [ -z "${CMAKE_GENERATOR:-}" ] &&
     command -v ninja >/dev/null; then
    generator=(-G Ninja)
  fi
  mkdir -p "$dir"
  if ! cmake --preset "$1" "${generator[@]}" >"$dir/configure.log" 2>&1; then
    cat "$dir/configure.log" >&2
    fail "configuring $dir failed"
  fi
  touch "$dir/configured"
  sed -n 's/^-- \(sphmbs \)/\1/p' "$dir/configure.log"
}

# build PRESET [TARGET...]: quiet unless it fails.
build() {
  local dir=build/$1 target=()
  [ $# -lt 2 ] || target=(--target "${@:2}")
  [ -f "$dir/build.log" ] || echo "building in $dir, which takes a while the first time"
  if ! cmake --build "$dir" --parallel "$(nproc)" "${target[@]}" >"$dir/build.log" 2>&1; then
    cat "$dir/build.log" >&2
    fail "building ${*:2} in $dir failed"
  fi
}
