# SPDX-License-Identifier: MIT
# cmake -D COMPILER=<C++ compiler> -D OBJDUMP=<objdump> -D PROCESSOR=<target> -D INCLUDE=<folder>
#   -D SOURCE=<source> -D OBJECT=<object file> -D "FLAGS=<list>" -D REGISTER=<xmm, ymm or zmm>
#   -D "FUNCTIONS=<list>" -P vector_code.cmake
# Compiles the pair loop at plain -O2 and fails unless the object code of each function computes with
# packs: whole registers in every loop over neighbours, nothing there one number at a time.
cmake_minimum_required(VERSION 3.22)

# Per loop: 1/(r h), the Riemann solver's 1/(Z_a + Z_b), 1/rho_b^2 and XSPH's 1/(rho_a + rho_b).
set(least_square_roots 1)
set(least_divisions 4)
# 1/rho_a^2 is the same for all neighbours and stays outside the loop.
set(most_scalar_divisions_in_loop 0)
# Inside a loop, jumps mean loops over lanes or axes that were left standing, and stores of less than
# a whole register mean packs put together in memory: both are slow.
set(most_jumps_in_loop 0)
set(most_narrow_stores_in_loop 0)
# Per particle: that one for the loop and for its last pack, away from periodic borders and near
# them, and eq. (23).
set(most_scalar_divisions 5)

if(NOT PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  message("skipped: no object code for x86-64 but for ${PROCESSOR}")
  return()
endif()
if(NOT OBJDUMP)
  message("skipped: no objdump")
  return()
endif()

get_filename_component(folder ${OBJECT} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
execute_process(
  COMMAND ${COMPILER} -std=c++20 -O2 -march=x86-64 ${FLAGS} -I${INCLUDE} -c ${SOURCE} -o ${OBJECT}
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${OBJDUMP} -d -r --no-show-raw-insn ${OBJECT}
  OUTPUT_VARIABLE listing COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[][;]" " " listing "${listing}")
string(REPLACE "\n" ";" listing "${listing}")

# Sets `code` to the lines of a function that matter below, in order, as "<address>:<what>", and
# `jumps` to its backward jumps as "<address jumped to>-<address of the jump>".
function(read_function name)
  set(inside OFF)
  set(found OFF)
  set(code)
  set(jumps)
  foreach(line IN LISTS listing)
    if(line MATCHES "^[0-9a-f]+ <(.*)>:")
      set(inside OFF)
      if(CMAKE_MATCH_1 MATCHES "^_?${name}([.]|$)")
        set(inside ON)
        set(found ON)
      endif()
      continue()
    endif()
    if(NOT inside OR NOT line MATCHES "^ *([0-9a-f]+):[ \t]+([a-z0-9]+)(.*)$")
      continue()
    endif()
    math(EXPR address 0x${CMAKE_MATCH_1})
    set(instruction ${CMAKE_MATCH_2})
    set(operands "${CMAKE_MATCH_3}")
    if(instruction MATCHES "^v?(sqrt|div)s[sd]$")
      list(APPEND code ${address}:${CMAKE_MATCH_1}_scalar)
    elseif(instruction MATCHES "^v?(sqrt|div)p[sd]$")
      set(what ${CMAKE_MATCH_1})
      string(REGEX MATCH "[xyz]mm" width "${operands}")
      list(APPEND code ${address}:${what}_${width})
    elseif(instruction MATCHES "^v?mov(u|a|dq)" AND NOT REGISTER STREQUAL "xmm"
           AND operands MATCHES "%xmm[0-9]+,.*[(]")
      list(APPEND code ${address}:narrow_store)
    elseif(instruction MATCHES "^call")
      list(APPEND code ${address}:call)
    elseif(instruction MATCHES "^ret")
      list(APPEND code ${address}:leave)
    elseif(instruction MATCHES "^j" AND operands MATCHES "^[ \t]+(0x)?([0-9a-f]+)")
      list(APPEND code ${address}:jump)
      math(EXPR to 0x${CMAKE_MATCH_2})
      if(to LESS_EQUAL address)
        list(APPEND jumps ${to}-${address})
      endif()
      if(instruction MATCHES "^jmp")
        list(APPEND code ${address}:leave)
      endif()
    endif()
  endforeach()
  if(NOT found)
    message(FATAL_ERROR "${SOURCE}: no function ${name} in the object code")
  endif()
  set(code "${code}" PARENT_SCOPE)
  set(jumps "${jumps}" PARENT_SCOPE)
endfunction()

# Sets <result> to how many lines of `code` are a `what` between two addresses.
function(count what first last result)
  set(n 0)
  foreach(line IN LISTS code)
    if(line MATCHES "^([0-9]+):${what}$" AND CMAKE_MATCH_1 GREATER_EQUAL first
       AND CMAKE_MATCH_1 LESS_EQUAL last)
      math(EXPR n "${n} + 1")
    endif()
  endforeach()
  set(${result} ${n} PARENT_SCOPE)
endfunction()

# Sets `loops` to the loops that take square roots: straight code from where a jump leads back to, as
# far as the jump. Code between that leaves means that the jump only comes back from code set aside.
function(find_loops)
  set(loops)
  foreach(jump IN LISTS jumps)
    string(REPLACE "-" ";" range ${jump})
    list(GET range 0 first)
    list(GET range 1 last)
    math(EXPR before_last "${last} - 1")
    count(sqrt_.* ${range} roots)
    count(leave ${first} ${before_last} leaves)
    if(roots GREATER 0 AND leaves EQUAL 0)
      list(APPEND loops ${jump})
    endif()
  endforeach()
  set(loops "${loops}" PARENT_SCOPE)
endfunction()

set(faults "")
list(JOIN FLAGS " " flags)
message("-O2 -march=x86-64 ${flags}")
foreach(name IN LISTS FUNCTIONS)
  read_function(${name})
  find_loops()
  set(everywhere 0 999999999)
  count(sqrt_${REGISTER} ${everywhere} roots)
  count(div_${REGISTER} ${everywhere} divisions)
  count(sqrt_scalar ${everywhere} scalar_roots)
  count(div_scalar ${everywhere} scalar_divisions)
  count(call ${everywhere} calls)
  message("${name}: ${REGISTER} square roots ${roots}, divisions ${divisions}; scalar square roots "
    "${scalar_roots}, divisions ${scalar_divisions}; calls ${calls}")
  if(calls GREATER 0)
    string(APPEND faults "\n${name}: ${calls} calls, of a square root or of what was not inlined")
  endif()
  if(scalar_roots GREATER 0)
    string(APPEND faults "\n${name}: ${scalar_roots} scalar square roots")
  endif()
  if(scalar_divisions GREATER most_scalar_divisions)
    string(APPEND faults
      "\n${name}: ${scalar_divisions} scalar divisions, at most ${most_scalar_divisions} expected")
  endif()
  list(LENGTH loops loop_count)
  if(loop_count LESS 2)
    string(APPEND faults
      "\n${name}: ${loop_count} loops over neighbours, expected one near periodic borders and one "
      "away from them")
  endif()
  foreach(loop IN LISTS loops)
    string(REPLACE "-" ";" range ${loop})
    count(sqrt_${REGISTER} ${range} roots)
    count(div_${REGISTER} ${range} divisions)
    count(sqrt_.* ${range} all_roots)
    count(div_.* ${range} all_divisions)
    list(GET range 0 first)
    list(GET range 1 last)
    math(EXPR before_last "${last} - 1")
    count(jump ${first} ${before_last} jumps_inside)
    count(narrow_store ${range} narrow_stores)
    message("  loop over neighbours: ${REGISTER} square roots ${roots} of ${all_roots}, "
      "divisions ${divisions} of ${all_divisions}; jumps ${jumps_inside}, narrow stores "
      "${narrow_stores}")
    if(jumps_inside GREATER most_jumps_in_loop
       OR narrow_stores GREATER most_narrow_stores_in_loop)
      string(APPEND faults
        "\n${name}: a loop over neighbours has ${jumps_inside} jumps and ${narrow_stores} narrow "
        "stores, at most ${most_jumps_in_loop} and ${most_narrow_stores_in_loop} expected")
    endif()
    if(roots LESS least_square_roots OR divisions LESS least_divisions)
      string(APPEND faults
        "\n${name}: a loop over neighbours has ${roots} square roots and ${divisions} divisions of "
        "whole ${REGISTER} registers, expected ${least_square_roots} and ${least_divisions}")
    endif()
    math(EXPR narrow "${all_divisions} - ${divisions}")
    if(roots LESS all_roots OR narrow GREATER most_scalar_divisions_in_loop)
      string(APPEND faults
        "\n${name}: a loop over neighbours takes square roots or divides in less than whole "
        "${REGISTER} registers")
    endif()
  endforeach()
endforeach()
if(faults)
  message("${faults}\n")
  message(FATAL_ERROR "The pair loop is not vectorised.")
endif()
