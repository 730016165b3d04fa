# Helpers that every folder's CMakeLists.txt uses: one target a folder, one test program a folder.
include(CheckCXXCompilerFlag)

find_package(Threads REQUIRED)

add_library(grove_options INTERFACE)
target_compile_options(grove_options INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast)
# GCC 12 sees overlaps in std::string's operator+ that are not there (GCC bug 105651).
target_compile_options(grove_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(GROVE_WERROR)
  target_compile_options(grove_options INTERFACE -Werror)
endif()
if(GROVE_ARCH)
  target_compile_options(grove_options INTERFACE -march=${GROVE_ARCH})
endif()
if(GROVE_SANITIZE)
  # GCC's own manual: sanitizers make -Wmaybe-uninitialized see what is not there.
  target_compile_options(grove_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_compile_options(grove_options INTERFACE -fsanitize=${GROVE_SANITIZE} -fno-omit-frame-pointer -g)
  target_link_options(grove_options INTERFACE -fsanitize=${GROVE_SANITIZE})
endif()

# Plain loops over floats that the compiler may vectorise: no errno, no traps, reassociation allowed.
add_library(grove_simd INTERFACE)
target_compile_options(grove_simd INTERFACE -O3 -ffast-math)
check_cxx_compiler_flag(-mprefer-vector-width=512 GROVE_HAS_PREFER_512)
if(GROVE_HAS_PREFER_512)
  target_compile_options(grove_simd INTERFACE -mprefer-vector-width=512)
endif()

# grove_library(NAME SOURCES ... HEADERS ... [SIMD ...] DEPS ...)
# The floor NAME of server/. SIMD names the sources that are compiled as vectorised loops.
# Every header must stand alone: `all_verify_interface_header_sets` compiles each by itself.
function(grove_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;HEADERS;SIMD;DEPS" ${ARGN})
  add_library(${name} STATIC ${arg_SOURCES} ${arg_SIMD})
  target_sources(${name} PUBLIC FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/server" FILES ${arg_HEADERS})
  set_target_properties(${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
  target_link_libraries(${name} PUBLIC grove_options Threads::Threads ${arg_DEPS})
  if(arg_SIMD)
    set_source_files_properties(${arg_SIMD} PROPERTIES
      COMPILE_OPTIONS "$<TARGET_PROPERTY:grove_simd,INTERFACE_COMPILE_OPTIONS>")
  endif()
endfunction()

# grove_embed(TARGET SYMBOL BASE_DIR FILES...)
# Compiles files into TARGET as `grove::embedded::SYMBOL()`, a span of {path, bytes}.
function(grove_embed target symbol base)
  set(out "${CMAKE_CURRENT_BINARY_DIR}/embedded_${symbol}.cpp")
  add_custom_command(OUTPUT "${out}"
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DSYMBOL=${symbol} -DBASE=${base} "-DFILES=${ARGN}"
            -P "${PROJECT_SOURCE_DIR}/server/cmake/embed.cmake"
    DEPENDS ${ARGN} "${PROJECT_SOURCE_DIR}/server/cmake/embed.cmake" VERBATIM)
  target_sources(${target} PRIVATE "${out}")
endfunction()

# grove_test(NAME SOURCES ... DEPS ...): one GoogleTest program, linked with the floors it tests only.
function(grove_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;DEPS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${name} PRIVATE ${arg_DEPS} GTest::gmock GTest::gtest_main)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${arg_TIMEOUT}
    ENVIRONMENT "GROVE_CACHE=${CMAKE_BINARY_DIR}/cache;TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/tsan.supp;LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/lsan.supp")
endfunction()
