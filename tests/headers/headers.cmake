# SPDX-FileCopyrightText: 2026 The ism authors
# SPDX-License-Identifier: MIT

# Every header alone: one source a header that includes it twice, so it lacks nothing and guards itself. All of
# them are linked into one program, so what is defined in a header is inline.
file(GLOB_RECURSE library_headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/include" "${PROJECT_SOURCE_DIR}/include/ism/*.hpp")
list(FILTER library_headers EXCLUDE REGEX "/adapt/(eigen|opencv|pcl)") # see bridge/
file(GLOB toy_headers CONFIGURE_DEPENDS RELATIVE "${PROJECT_SOURCE_DIR}/examples" "${PROJECT_SOURCE_DIR}/examples/toy/*.hpp")

set(sources "${test_build_dir}/headers/main.cpp")
file(CONFIGURE OUTPUT "${test_build_dir}/headers/main.cpp" CONTENT "int main() {}\n")
foreach(header IN LISTS library_headers toy_headers)
    string(MAKE_C_IDENTIFIER "${header}" name)
    set(source "${test_build_dir}/headers/${name}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "#include \"${header}\"\n#include \"${header}\"  // a second time\n")
    list(APPEND sources "${source}")
endforeach()

add_executable(header_check EXCLUDE_FROM_ALL ${sources})
set_target_properties(header_check PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${test_build_dir}/headers")
target_link_libraries(header_check PRIVATE ism_dev_options)
target_compile_options(header_check PRIVATE -O0)
# What most of the time would go to, read once; that each includes what it names of it is check_standard_includes' to say.
target_precompile_headers(header_check PRIVATE <algorithm> <array> <cmath> <filesystem> <functional> <fstream> <map> <memory> <optional> <span> <string>
                          <thread> <variant> <vector>)

# All that fail are told, not the first alone.
set(keep_going "")
if(CMAKE_GENERATOR MATCHES "Ninja")
    set(keep_going -- -k 0 --quiet)
elseif(CMAKE_GENERATOR MATCHES "Makefiles")
    set(keep_going -- -k)
endif()
add_test(NAME headers COMMAND "${CMAKE_COMMAND}" --build "${CMAKE_BINARY_DIR}" --target header_check ${keep_going})
set_tests_properties(headers PROPERTIES LABELS headers TIMEOUT 900 PROCESSORS 2 COST 200)
