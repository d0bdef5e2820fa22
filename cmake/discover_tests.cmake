# SPDX-License-Identifier: MIT
# Run after a test program is built: writes CTEST_FILE, with one CTest test for each test case. Its
# labels are the kind of test and its speed, and `fault` for the tag [fault].
cmake_minimum_required(VERSION 3.22)

set(timeout_quick 300)
set(timeout_slow 3600)
set(timeout_long 14400)

function(list_cases spec result)
  execute_process(COMMAND "${PROGRAM}" "${spec}" ${LIST_OPTIONS}
    OUTPUT_VARIABLE output ERROR_VARIABLE errors RESULT_VARIABLE code)
  # Catch2 2 returns the number of cases, so only a signal or a missing program is a failure.
  if(NOT code MATCHES "^[0-9]+$")
    message(FATAL_ERROR "${NAME} cannot list its tests: ${code}\n${output}${errors}")
  endif()
  string(REPLACE ";" "\\;" output "${output}")
  string(REGEX REPLACE "\n$" "" output "${output}")
  string(REPLACE "\n" ";" output "${output}")
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

set(script "")
list_cases("[fault]" faults)
function(append_cases spec speed)
  list_cases("${spec}" cases)
  foreach(case IN LISTS cases)
    string(REPLACE "\\" "\\\\" pattern "${case}")
    string(REPLACE "," "\\," pattern "${pattern}")
    string(REPLACE "[" "\\[" pattern "${pattern}")
    set(labels "${KIND};${speed}")
    if(case IN_LIST faults)
      list(APPEND labels fault)
    endif()
    string(APPEND script
      "add_test([==[${NAME}: ${case}]==] [==[${PROGRAM}]==] [==[${pattern}]==])\n"
      "set_tests_properties([==[${NAME}: ${case}]==] PROPERTIES LABELS \"${labels}\" "
      "TIMEOUT ${timeout_${speed}} ENVIRONMENT \"${ENVIRONMENT}\")\n")
  endforeach()
  set(script "${script}" PARENT_SCOPE)
endfunction()

append_cases("~[.]~[slow]~[long]" quick)
append_cases("~[.][slow]~[long]" slow)
append_cases("~[.][long]" long)
file(WRITE "${CTEST_FILE}" "${script}")
