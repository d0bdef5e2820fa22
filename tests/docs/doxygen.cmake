# SPDX-License-Identifier: MIT
# cmake -D DOXYGEN=program -D OUTPUT=folder -P doxygen.cmake, in the root of the repository.
# Fails where Doxygen warns: of public names that are not documented, of links, of commands.
file(MAKE_DIRECTORY ${OUTPUT})
file(WRITE ${OUTPUT}/Doxyfile "@INCLUDE = docs/Doxyfile\nOUTPUT_DIRECTORY = ${OUTPUT}\n")
execute_process(COMMAND ${DOXYGEN} ${OUTPUT}/Doxyfile RESULT_VARIABLE result ERROR_VARIABLE said)
if(result OR NOT EXISTS ${OUTPUT}/html/index.html)
  message(FATAL_ERROR "${said}")
endif()
