# SPDX-License-Identifier: MIT
# C++ of the Markdown pages as programs and object files, so that no page shows what does not
# compile. In the line above each ```cpp fence stands what becomes of it:
#   <!-- compile: program -->             a whole program, built and run in an empty folder
#   <!-- compile: page -->                all of these of a page, one after the other, are a program
#   <!-- compile: file -->                declarations, in a namespace of the page, after fragments.hpp
#   <!-- compile: body, PRELUDE -->       statements, after those of preludes/PRELUDE.inc
#   <!-- compile: body, PRELUDE, if TARGET -->  the same, where there is such a target
#   <!-- compile: as examples/x.cpp -->   stands in this file, line for line
#   <!-- compile: no, REASON -->          is not compiled

# Writes a file only if that changes it, so that nothing is compiled again without need.
function(sphmbs_write_source path text)
  file(WRITE ${path}.new "${text}")
  configure_file(${path}.new ${path} COPYONLY)
endfunction()

# Takes page (a path from the root of the repository) apart. In the caller's scope: programs (of
# .cpp files), fragments (of .cpp files), skipped (places and reasons).
function(sphmbs_take_snippets page folder)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${page})
  file(READ ${PROJECT_SOURCE_DIR}/${page} text)
  string(MAKE_C_IDENTIFIER "${page}" name)
  set(rest "${text}")
  set(line 1)
  set(whole "")
  set(declarations "")
  while(true)
    string(FIND "${rest}" "\n```c" start)
    if(start EQUAL -1)
      break()
    endif()
    math(EXPR start "${start} + 1")
    string(SUBSTRING "${rest}" 0 ${start} before)
    string(SUBSTRING "${rest}" ${start} -1 rest)
    string(FIND "${rest}" "\n" end)
    string(SUBSTRING "${rest}" 0 ${end} fence)
    math(EXPR end "${end} + 1")
    string(SUBSTRING "${rest}" ${end} -1 rest)
    string(FIND "${rest}" "\n```" end)
    math(EXPR end "${end} + 1")
    string(SUBSTRING "${rest}" 0 ${end} code)
    string(SUBSTRING "${rest}" ${end} -1 rest)
    string(REGEX MATCHALL "\n" lines "${before}")
    list(LENGTH lines count)
    math(EXPR line "${line} + ${count} + 1")
    set(place "#line ${line} \"${PROJECT_SOURCE_DIR}/${page}\"\n")
    set(here "${page}:${line}")
    string(REGEX MATCHALL "\n" lines "${code}")
    list(LENGTH lines count)
    math(EXPR line "${line} + ${count}")

    string(REGEX MATCH "<!-- compile: ([^\n]*) -->\n$" marker "${before}")
    set(marker "${CMAKE_MATCH_1}")
    if(fence STREQUAL "```cmake")
      continue()
    elseif(NOT fence STREQUAL "```cpp")
      string(APPEND declarations "${place}#error write ```cpp in place of ${fence}\n")
    elseif(marker STREQUAL "program")
      string(MAKE_C_IDENTIFIER "${here}" source)
      sphmbs_write_source(${folder}/${source}.cpp "${place}${code}")
      list(APPEND programs ${folder}/${source}.cpp)
    elseif(marker STREQUAL "page")
      string(APPEND whole "${place}${code}")
    elseif(marker STREQUAL "file")
      string(APPEND declarations "${place}${code}")
    elseif(marker MATCHES "^body, ([a-z_]+)(, if ([a-z0-9:]+))?$")
      if(CMAKE_MATCH_3 AND NOT TARGET ${CMAKE_MATCH_3})
        list(APPEND skipped "${here} (needs ${CMAKE_MATCH_3})")
        continue()
      endif()
      string(APPEND declarations "void statements_${line}() {\n"
        "#include \"preludes/${CMAKE_MATCH_1}.inc\"\n${place}${code}}\n")
    elseif(marker MATCHES "^as ([a-z_/.]+)$")
      file(READ ${PROJECT_SOURCE_DIR}/${CMAKE_MATCH_1} file)
      set_property(DIRECTORY APPEND PROPERTY
        CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${CMAKE_MATCH_1})
      string(FIND "${file}" "${code}" found)
      if(found EQUAL -1)
        string(APPEND declarations "${place}#error ${CMAKE_MATCH_1} has other lines\n")
      endif()
    elseif(marker MATCHES "^no, (.+)$")
      list(APPEND skipped "${here} (${CMAKE_MATCH_1})")
    else()
      string(APPEND declarations
        "${place}#error write <!-- compile: ... --> above, see tests/docs/snippets.cmake\n")
    endif()
  endwhile()
  if(whole)
    sphmbs_write_source(${folder}/${name}.cpp "${whole}")
    list(APPEND programs ${folder}/${name}.cpp)
  endif()
  if(declarations)
    sphmbs_write_source(${folder}/${name}_fragments.cpp
      "#include \"fragments.hpp\"\nnamespace ${name} {\n${declarations}}\n")
    list(APPEND fragments ${folder}/${name}_fragments.cpp)
  endif()
  foreach(list IN ITEMS programs fragments skipped)
    set(${list} ${${list}} PARENT_SCOPE)
  endforeach()
endfunction()
