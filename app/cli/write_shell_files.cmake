# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# FOLDER gets the manual pages, completions and bill of materials that PROGRAM prints, in the places below share/ where they are looked for.
function(print file)
  execute_process(COMMAND "${PROGRAM}" ${ARGN} OUTPUT_VARIABLE text RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "treadmark ${ARGN} ended with ${status}")
  endif()
  file(WRITE "${FOLDER}/${file}" "${text}")
endfunction()

print(bash-completion/completions/treadmark completion bash)
print(zsh/vendor-completions/_treadmark completion zsh)
print(fish/vendor_completions.d/treadmark.fish completion fish)
print(man/man1/treadmark.1 man)
print(doc/treadmark/treadmark.spdx.json --version --spdx)
execute_process(COMMAND "${PROGRAM}" list verbs OUTPUT_VARIABLE verbs)
string(REGEX MATCHALL "[^\n]+" verbs "${verbs}")
foreach(verb IN LISTS verbs)
  if(NOT verb MATCHES " ")  # else it is left out of this build
    print(man/man1/treadmark-${verb}.1 man ${verb})
  endif()
endforeach()
