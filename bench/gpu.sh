#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Checks and times every device policy on the GPU at hand: devices, ceilings, equality with the host,
# pair loop, neighbour search, whole steps, and with --cases the paper's cases at full size.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

usage='usage: bench/gpu.sh [--quick] [--cases] [--arch sm_NN] [POLICY...]
  builds what the compilers of this machine can, then checks and times it on its GPU
       bench/gpu.sh --pack DIR [--cases] [--arch sm_NN] [POLICY...]
  builds the same and puts it into DIR with the libraries it needs, for a machine without compilers;
  there: DIR/gpu.sh [--quick] [--cases] [POLICY...]
The policies are openacc, omp_target (by Clang), omp_target_gcc and cuda. --quick uses small sizes.
--arch is the GPU that Clang and nvcc compile for, else that of this machine, else sm_80.
Runs end ten minutes after the first one began (SPHMBS_GPU_SECONDS, default 570).
ACC_DEVICE_TYPE=host OMP_TARGET_OFFLOAD=DISABLED lets the host stand in for the GPU.
The exit code is 0 where every policy that was found is right.'

quick=() cases=0 pack='' arch='' policies=() status=0 ran=0 begun=''
while [ $# -gt 0 ]; do
  case $1 in
    -h | --help) echo "$usage"; exit 0 ;;
    --quick) quick=(--quick) ;;
    --cases) cases=1 ;;
    --pack) pack=${2:?"$usage"}; shift ;;
    --arch) arch=${2:?"$usage"}; shift ;;
    openacc | omp_target | omp_target_gcc | cuda) policies+=("$1") ;;
    *) echo "$usage" >&2; exit 2 ;;
  esac
  shift
done
[ ${#policies[@]} -gt 0 ] || policies=(openacc omp_target omp_target_gcc cuda)

# Seconds that are left for runs.
left() {
  local seconds=$((begun + ${SPHMBS_GPU_SECONDS:-570} - SECONDS))
  echo $((seconds > 1 ? seconds : 1))
}

preset_of() {
  case $1 in
    openacc | cuda) echo "$1" ;;
    omp_target) echo omp-target-clang ;;
    omp_target_gcc) echo omp-target ;;
  esac
}

# Cases that a policy can have: bodies are beyond nvcc 13, which crashes on them.
programs_of() {
  case $1 in
    cuda) echo gas_cylinder ;;
    *) echo gas_cylinder pendulum_on_cable falling_plates ;;
  esac
}

# build POLICY: into build/gpu-POLICY; fails where there is no compiler for it.
build() {
  local dir=$root/build/gpu-$1 log=$root/build/gpu-$1.log program
  mkdir -p "$root/build"
  # For any processor, since the GPU may be another machine's.
  if ! (cd "$root" && cmake --preset "$(preset_of "$1")" -B "$dir" -DSPHMBS_BUILD_BENCH=ON \
        -DSPHMBS_REQUIRE_ALL=OFF -DSPHMBS_NATIVE=OFF -DSPHMBS_GPU_ARCH="$arch") >"$log" 2>&1; then
    echo "$1: not built: $(grep -m 1 'no policy' "$log" | sed 's/^-- sphmbs: //' || echo "see $log")"
    return 1
  fi
  sed -n 's/^-- sphmbs: \(omp_target: .*\)/\1/p' "$log"
  if ! cmake --build "$dir" --parallel "$(nproc)" --target bench_gpu >>"$log" 2>&1; then
    echo "$1: not built: see $log"
    status=1
    return 1
  fi
  [ $cases -eq 1 ] || return 0
  for program in $(programs_of "$1"); do
    cmake --build "$dir" --parallel "$(nproc)" --target "$program" >>"$log" 2>&1 ||
      echo "$1: no $program: see $log"
  done
}

# collect POLICY FOLDER: the programs and what they load, without the C library itself.
collect() {
  local dir=$root/build/gpu-$1 to=$2 program library
  mkdir -p "$to/lib"
  cp "$dir/bench/gpu/bench_gpu" "$to/"
  if [ $cases -eq 1 ]; then
    for program in $(programs_of "$1"); do
      [ ! -f "$dir/examples/$program" ] || cp "$dir/examples/$program" "$to/"
    done
  fi
  for program in "$to"/*; do
    [ -f "$program" ] || continue
    ldd "$program" | awk '$3 ~ /^\// { print $3 }'
  done | sort -u | grep -vE '/(libc|libm|ld-linux[^/]*|libpthread|libdl|librt|libcuda)\.so' |
    while read -r library; do cp -L "$library" "$to/lib/"; done
  case $1 in
    openacc | omp_target_gcc)
      # Loaded by libgomp when it looks for devices.
      library=$(g++ -print-file-name=libgomp-plugin-nvptx.so.1)
      [ ! -f "$library" ] || cp -L "$library" "$to/lib/" ;;
  esac
}

# run POLICY FOLDER LIBRARIES: the whole of the measurements.
run() {
  local backend=${1%_gcc} programs_dir=$2 links driver
  # Clang's runtime looks for libcuda.so, without its version.
  links=$(mktemp -d)
  for driver in $(ldconfig -p 2>/dev/null | awk '/libcuda\.so\.1 / { print $NF }') \
      /usr/local/nvidia/lib64/libcuda.so.1; do
    [ ! -e "$driver" ] || ln -sf "$driver" "$links/libcuda.so"
  done
  export LD_LIBRARY_PATH=$3:$links:/usr/local/nvidia/lib64:${saved_path}
  echo "== $1"
  ran=1
  [ -n "$begun" ] || begun=$SECONDS
  if ! timeout "$(left)" "$programs_dir/bench_gpu" "${quick[@]}"; then
    echo "$1: FAILED"
    status=1
  fi
  if [ $cases -eq 1 ]; then
    local until=1
    [ ${#quick[@]} -eq 0 ] || until=0.002
    case_run "case 1, 1 s" gas_cylinder --spacing 0.1 --until $until
    case_run "case 3, 1 s" pendulum_on_cable --spacing 0.05 --until $until
    case_run "case 4 IV, 2000 steps" falling_plates --spacing 0.0666666666666667 --step 5e-4 \
      --until $until
  fi
  rm -rf "$links"
}

case_run() {
  local name=$1 program=$programs_dir/$2 out
  shift 2
  [ -x "$program" ] || return 0
  out=$(mktemp -d)
  if timeout "$(left)" "$program" "$@" --backend "$backend" --output "$out/results" >"$out/log" 2>&1; then
    echo "$name: $(grep '^done' "$out/log" | sed 's/  */ /g'); $(grep '^pairs' "$out/log" | sed 's/  */ /g')"
    grep '^phases' "$out/log" || true
  else
    echo "$name: did not end in time, or failed: $(tail -n 1 "$out/log")"
    status=1
  fi
  rm -rf "$out"
}

saved_path=${LD_LIBRARY_PATH:-}
if command -v nvidia-smi >/dev/null; then
  nvidia-smi --query-gpu=name,driver_version,memory.total --format=csv,noheader || true
else
  echo "no nvidia-smi: no driver of NVIDIA on this machine"
fi
if [ ! -f "$here/gpu/gpu.cpp" ]; then # carried here
  for policy in "${policies[@]}"; do
    [ ! -d "$here/$policy" ] || run "$policy" "$here/$policy" "$here/$policy/lib"
  done
  [ $ran -eq 1 ] || { echo "no program of these policies here" >&2; exit 2; }
  exit $status
fi

if [ -z "$arch" ]; then
  arch=sm_$(nvidia-smi --query-gpu=compute_cap --format=csv,noheader 2>/dev/null | head -n 1 | tr -d .)
  [ "$arch" != sm_ ] || arch=sm_80
fi
root=$(cd "$here/.." && pwd)
[ -z "$pack" ] || { mkdir -p "$pack" && cp "$here/gpu.sh" "$pack/"; }
for policy in "${policies[@]}"; do
  build "$policy" || continue
  if [ -n "$pack" ]; then
    collect "$policy" "$pack/$policy"
    echo "$policy: packed for $arch, $(du -sh "$pack/$policy" | cut -f 1)"
    ran=1
  else
    folder=$(mktemp -d)
    collect "$policy" "$folder"
    run "$policy" "$folder" "$folder/lib"
    rm -rf "$folder"
  fi
done
[ $ran -eq 1 ] || { echo "no policy could be built" >&2; exit 2; }
exit $status
