#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Is there device code of GCC in a program, and is it good? Needs no GPU.

Takes the PTX out of the program, lets CUDA's ptxas and nvlink build it where they are installed, and
holds registers and stack of every kernel to limits. Ends with 1 where one is broken.
"""
import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def modules_of(program):
    """PTX texts in a program, each of which ends with a zero byte."""
    image = pathlib.Path(program).read_bytes()
    begin = b"// BEGIN PREAMBLE\n"
    places = [match.start() for match in re.finditer(re.escape(begin), image)]
    return [image[at:image.index(b"\0", at)].decode() for at in places]


def soft_frames(module):
    """(function, bytes) of the stack that GCC's OpenMP keeps by software for called functions."""
    for function in module.split("// BEGIN FUNCTION DEF: ")[1:]:
        name = function.split("\n", 1)[0]
        if "_omp_fn" in name:
            continue
        for size in re.findall(r"sub\.u64 %frame,%sspprev,(\d+)", function):
            yield name, int(size)


def resources(modules, architecture):
    """(kernel, registers, bytes of stack), by CUDA's own assembler and linker."""
    with tempfile.TemporaryDirectory() as folder:
        objects = []
        for number, text in enumerate(modules):
            source = pathlib.Path(folder, f"{number}.ptx")
            source.write_text(text)
            objects.append(str(source.with_suffix(".cubin")))
            subprocess.run(["ptxas", "-c", f"-arch={architecture}", str(source), "-o", objects[-1]],
                           check=True)
        linked = subprocess.run(["nvlink", f"--arch={architecture}", "-m64", "-v", *objects, "-o",
                                 f"{folder}/all.cubin"], check=True, capture_output=True, text=True)
    pattern = r"properties for '([^']+)':\s*\n.*?used (\d+) registers.*?(\d+) stack"
    for name, registers, stack in re.findall(pattern, linked.stdout + linked.stderr):
        yield name, int(registers), int(stack)


def readable(names):
    if not names or not shutil.which("c++filt"):
        return dict(zip(names, names))
    plain = subprocess.run(["c++filt"], input="\n".join(n.split("$")[0] for n in names), text=True,
                           capture_output=True, check=True).stdout.splitlines()
    body = [re.sub(r".*for_each<(.*)>\(.*|.*call_boxed<(.*)>\(.*", r"\1\2", p) for p in plain]
    return dict(zip(names, (b.replace("sphmbs::", "") for b in body)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--arch", default="sm_90", help="GPU (default %(default)s)")
    parser.add_argument("--kernels", type=int, default=1, help="fewest kernels expected")
    parser.add_argument("--hot", default="EvaluateRates|EvaluateSlopes|CountNeighbours|ListNeighbours",
                        help="kernels whose stack is limited by --hot-stack (default %(default)s)")
    parser.add_argument("--registers", type=int, default=255)
    parser.add_argument("--hot-stack", type=int, default=0, help="[bytes]")
    parser.add_argument("--stack", type=int, default=1024, help="of the others [bytes]")
    parser.add_argument("--soft-frame", type=int, default=128,
                        help="of functions that GCC's OpenMP calls [bytes]")
    parser.add_argument("--list", action="store_true", help="print every kernel")
    options = parser.parse_args()

    modules = modules_of(options.program)
    kernels = {name for text in modules
               for name in re.findall(r"^(?:\.visible )?\.entry (\S+)", text, re.M)}
    print(f"{options.program}: {len(kernels)} kernels in {len(modules)} PTX modules")
    faults = []
    if len(kernels) < options.kernels:
        faults.append(f"{len(kernels)} kernels, at least {options.kernels} expected")
    for text in modules:
        for name, size in soft_frames(text):
            if size > options.soft_frame:
                faults.append(f"{readable([name])[name]}: soft frame of {size} bytes")
    if modules and shutil.which("ptxas") and shutil.which("nvlink"):
        found = list(resources(modules, options.arch))
        if len(found) < options.kernels:
            faults.append(f"nvlink tells of {len(found)} kernels only")
        names = readable([name for name, _, _ in found])
        for name, registers, stack in sorted(found, key=lambda k: -k[1]):
            line = f"{registers:4} registers {stack:5} bytes of stack  {names[name]}"
            if options.list:
                print(line[:200])
            allowed = options.hot_stack if re.search(options.hot, name) else options.stack
            if registers > options.registers or stack > allowed:
                faults.append(line)
    else:
        print("no ptxas and nvlink: registers and stack are not checked")
    print("\n".join(faults) if faults else "device code is within its limits")
    sys.exit(bool(faults))


if __name__ == "__main__":
    main()
