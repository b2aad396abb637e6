# Labels for the tests of one program. CTest reads this file at its start, after the list of that program's tests, so
# changing a label needs no build.
#
# A comment in the line before a test gives it labels, words separated by spaces:
#
#     // Labels: slow no-asan
#     TEST(Suite, name) {
#
# `// Labels of this file: …` applies to every test of the file; `// Labels on Vulkan: …` to a test only in the run on
# the Vulkan backend; `// Labels with "VALUE": …` to a parameterized test only with this text as its parameter. docs/architecture.md explains each label. A test that is neither `slow` nor `long` gets `quick`.
#
# Input: weft_discovered (names of tests), weft_prefix (of these names), weft_labels (of all of them), weft_sources.

cmake_policy(VERSION 3.25)
set(test_macro "TEST(_F|_P)?\\([ \n]*([A-Za-z0-9_]+),[ \n]*([A-Za-z0-9_]+)\\)")
set(labelled)
set(on_vulkan)
if(weft_prefix STREQUAL "Vulkan.")
    set(on_vulkan "| on Vulkan")
endif()
foreach(source IN LISTS weft_sources)
    file(READ ${source} text)
    set(of_file)
    if(text MATCHES "// Labels of this file: ([a-z -]+)\n")
        string(REPLACE " " ";" of_file "${CMAKE_MATCH_1}")
    endif()
    string(REGEX MATCHALL "(// Labels[^\n]*\n)*${test_macro}" tests "${text}")
    foreach(test IN LISTS tests)
        set(labels ${of_file})
        set(with)   # VALUE=label, of parameters
        string(REGEX MATCHALL "// Labels[^\n]*" comments "${test}")
        foreach(comment IN LISTS comments)
            # One match: a second one that fails in the same condition would clear CMAKE_MATCH_2.
            if(comment MATCHES "^// Labels(${on_vulkan}): (.*)")
                string(REPLACE " " ";" own "${CMAKE_MATCH_2}")
                list(APPEND labels ${own})
            elseif(comment MATCHES "^// Labels with (\"[^\"]+\"): (.*)")
                set(value ${CMAKE_MATCH_1})
                string(REPLACE " " ";" own "${CMAKE_MATCH_2}")
                list(TRANSFORM own PREPEND "${value}=")
                list(APPEND with ${own})
            endif()
        endforeach()
        if((labels OR with) AND test MATCHES "${test_macro}")
            set(name ${CMAKE_MATCH_2}.${CMAKE_MATCH_3})
            set(labels_of_${name} ${labels})
            set(with_of_${name} ${with})
            list(APPEND labelled ${name})
        endif()
    endforeach()
endforeach()

foreach(test IN LISTS weft_discovered)
    # [prefix][instantiation/]suite.name[/parameter]
    string(LENGTH "${weft_prefix}" start)
    string(SUBSTRING "${test}" ${start} -1 name)
    set(parameter)
    if(name MATCHES "^([^/.]+/)?([^/.]+\\.[^/]+)(/(.*))?")
        set(name ${CMAKE_MATCH_2})
        set(parameter ${CMAKE_MATCH_4})
    endif()
    set(labels ${weft_labels})
    if(name IN_LIST labelled)
        list(APPEND labels ${labels_of_${name}})
        foreach(one IN LISTS with_of_${name})
            if(one MATCHES "^(.*)=(.*)$" AND parameter STREQUAL CMAKE_MATCH_1)
                list(APPEND labels ${CMAKE_MATCH_2})
            endif()
        endforeach()
    endif()
    if(NOT "slow" IN_LIST labels AND NOT "long" IN_LIST labels)
        list(APPEND labels quick)
    endif()
    set_tests_properties("${test}" PROPERTIES LABELS "${labels}")
endforeach()

foreach(name IN LISTS labelled)
    unset(labels_of_${name})
    unset(with_of_${name})
endforeach()
unset(weft_discovered)
