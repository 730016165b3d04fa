# Helpers for the CMakeLists.txt of all folders: one target per folder, one test program per folder.
include(CheckCXXCompilerFlag)

find_package(Threads REQUIRED)

add_library(grove_options INTERFACE)
target_compile_options(grove_options INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast)
# GCC 12 warns falsely about overlaps and overflows in std::string's operator+ (GCC bug 105651).
target_compile_options(grove_options INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict;-Wno-stringop-overflow>")
if(GROVE_WERROR)
  target_compile_options(grove_options INTERFACE -Werror)
endif()
# The oldest processor that Grove runs on. Code that needs more is a kernel, chosen at run time (base/simd/target.h).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(grove_options INTERFACE -march=x86-64-v2)
  # On older processors the loader reports this, instead of a crash at some instruction.
  target_link_options(grove_options INTERFACE LINKER:-z,x86-64-v2)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  target_compile_options(grove_options INTERFACE -march=armv8-a)
endif()
# All code except kernels computes the same on every processor: on ARM, compilers contract to fused arithmetic by
# default.
target_compile_options(grove_options INTERFACE -ffp-contract=off)
if(GROVE_SANITIZE)
  # GCC's manual: sanitizers cause some false warnings.
  target_compile_options(grove_options INTERFACE
    "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-array-bounds>")
  target_compile_options(grove_options INTERFACE -fsanitize=${GROVE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(grove_options INTERFACE -fsanitize=${GROVE_SANITIZE})
  if(GROVE_SANITIZE MATCHES "undefined")
    # Checks at every pointer access, which take half of the compile time. The address sanitizer detects null pointers
    # and undersized objects, and every processor that Grove runs on supports unaligned loads.
    target_compile_options(grove_options INTERFACE -fno-sanitize=null,alignment,vptr,object-size)
  endif()
endif()

# Kernels use fast arithmetic: no errno, no traps, reassociation allowed; on AVX-512 the compiler uses full-width
# vectors. A sanitizer's checks prevent vectorisation, so there -O3 would only cost time.
add_library(grove_kernels INTERFACE)
target_compile_options(grove_kernels INTERFACE -ffast-math -ffp-contract=fast)
if(NOT GROVE_SANITIZE)
  target_compile_options(grove_kernels INTERFACE -O3)
endif()
check_cxx_compiler_flag(-mprefer-vector-width=512 GROVE_HAS_PREFER_512)
if(GROVE_HAS_PREFER_512)
  target_compile_options(grove_kernels INTERFACE -mprefer-vector-width=512)
endif()

# Exact kernels compute the same on every target: no rearrangement, and products and sums are fused only where a kernel
# does so explicitly.
add_library(grove_exact_kernels INTERFACE)
target_compile_options(grove_exact_kernels INTERFACE -O3)

# grove_library(NAME SOURCES ... HEADERS ... [KERNELS ...] [EXACT_KERNELS ...] DEPS ...): a floor of server/, or a part
# of one. KERNELS and EXACT_KERNELS name the sources that contain kernels. Every header must be self-contained:
# `all_verify_interface_header_sets` compiles each one alone. precompiled.h belongs to `base`, and every floor uses it;
# kernels cannot, because their options differ.
function(grove_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;HEADERS;KERNELS;EXACT_KERNELS;DEPS" ${ARGN})
  add_library(${name} STATIC ${arg_SOURCES} ${arg_KERNELS} ${arg_EXACT_KERNELS})
  target_sources(${name} PUBLIC FILE_SET HEADERS BASE_DIRS "${PROJECT_SOURCE_DIR}/server" FILES ${arg_HEADERS})
  set_target_properties(${name} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
  target_link_libraries(${name} PUBLIC grove_options Threads::Threads ${arg_DEPS})
  if(name STREQUAL base)
    target_precompile_headers(base PRIVATE "${PROJECT_SOURCE_DIR}/server/cmake/precompiled.h")
  else()
    target_precompile_headers(${name} REUSE_FROM base)
  endif()
  if(arg_KERNELS)
    set_source_files_properties(${arg_KERNELS} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
      COMPILE_OPTIONS "$<TARGET_PROPERTY:grove_kernels,INTERFACE_COMPILE_OPTIONS>")
  endif()
  if(arg_EXACT_KERNELS)
    set_source_files_properties(${arg_EXACT_KERNELS} PROPERTIES SKIP_PRECOMPILE_HEADERS ON
      COMPILE_OPTIONS "$<TARGET_PROPERTY:grove_exact_kernels,INTERFACE_COMPILE_OPTIONS>")
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

# grove_embed_web(TARGET WEB_DIR SOURCES...): the same as `grove::embedded::web()`, for the pages made from these
# sources (web.cmake).
function(grove_embed_web target web)
  find_program(GROVE_ESBUILD esbuild REQUIRED)
  find_program(GROVE_GZIP gzip REQUIRED)
  find_program(GROVE_BROTLI brotli REQUIRED)
  set(out "${CMAKE_CURRENT_BINARY_DIR}/embedded_web.cpp")
  set(scripts "${PROJECT_SOURCE_DIR}/server/cmake/web.cmake" "${PROJECT_SOURCE_DIR}/server/cmake/embed.cmake")
  add_custom_command(OUTPUT "${out}"
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DSYMBOL=web -DWEB=${web} -DBASE=${CMAKE_CURRENT_BINARY_DIR}/web
            -DESBUILD=${GROVE_ESBUILD} -DGZIP=${GROVE_GZIP} -DBROTLI=${GROVE_BROTLI}
            -P "${PROJECT_SOURCE_DIR}/server/cmake/web.cmake"
    DEPENDS ${ARGN} ${scripts} VERBATIM)
  target_sources(${target} PRIVATE "${out}")
endfunction()

# grove_test(NAME [CONCURRENT] [WAITS] [NO_CTEST] SOURCES ... DEPS ...): one GoogleTest program, linked only with the floors that
# it tests. CONCURRENT: it also runs under the thread sanitizer. `kernel_tests` builds the programs that have a source
# named *_kernels_test.cpp, and kernel_tests.txt in the build folder lists them. SHARDS: number of ctest entries, name_1
# and so on, each of which runs its share of the tests in parallel. WAITS: it leaves a core idle at least half of the
# time, so ctest runs two such entries per core (deploy/test passes -j with twice the cores). NO_CTEST: deploy/test runs it.
function(grove_test name)
  cmake_parse_arguments(arg "CONCURRENT;NO_CTEST;WAITS" "TIMEOUT;SHARDS" "SOURCES;DEPS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  if(GROVE_SANITIZE)  # which slow some programs down by ten
    math(EXPR arg_TIMEOUT "3 * ${arg_TIMEOUT}")
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/tests")
  target_link_libraries(${name} PRIVATE ${arg_DEPS} grove_test_main)
  target_precompile_headers(${name} REUSE_FROM grove_test_main)
  if(arg_SOURCES MATCHES "_kernels_test\\.cpp")
    set_property(GLOBAL APPEND PROPERTY GROVE_KERNEL_TESTS ${name})
  endif()
  if(NOT arg_SHARDS)
    set(arg_SHARDS 1)
  endif()
  set(half_cores 2)
  if(arg_WAITS)
    set(half_cores 1)
  endif()
  set_target_properties(${name} PROPERTIES GROVE_SHARDS ${arg_SHARDS} GROVE_TIMEOUT ${arg_TIMEOUT}
    GROVE_HALF_CORES ${half_cores})
  if(arg_CONCURRENT)
    set_target_properties(${name} PROPERTIES GROVE_LABELS concurrent)
    add_dependencies(concurrent_tests ${name})
  endif()
  if(NOT arg_NO_CTEST)
    grove_add_tests(${name} ${name})
  endif()
endfunction()

# grove_add_tests(PROGRAM NAME [ENVIRONMENT...]): a test program's ctest entries, with additional environment variables.
function(grove_add_tests program name)
  get_target_property(shards ${program} GROVE_SHARDS)
  get_target_property(timeout ${program} GROVE_TIMEOUT)
  get_target_property(half_cores ${program} GROVE_HALF_CORES)
  get_target_property(labels ${program} GROVE_LABELS)
  # Entries that take a whole core start first, otherwise waiting ones would take half of each free core; then the slow
  # ones.
  math(EXPR cost "10000 * ${half_cores} + ${timeout}")
  foreach(shard RANGE 1 ${shards})
    set(entry ${name})
    set(share)
    if(shards GREATER 1)
      set(entry ${name}_${shard})
      math(EXPR index "${shard} - 1")
      set(share GTEST_TOTAL_SHARDS=${shards} GTEST_SHARD_INDEX=${index})
    endif()
    add_test(NAME ${entry} COMMAND ${program})
    # A small quarantine returns freed memory soon, because some tests measure memory; undefined behaviour fails its
    # test.
    set(environment "GROVE_CACHE=${CMAKE_BINARY_DIR}/cache" ASAN_OPTIONS=quarantine_size_mb=16
      UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 "TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/tsan.supp"
      "LSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/lsan.supp" ${share} ${ARGN})
    set_tests_properties(${entry} PROPERTIES TIMEOUT ${timeout} COST ${cost} PROCESSORS ${half_cores}
      ENVIRONMENT "${environment}")
    if(labels)
      set_tests_properties(${entry} PROPERTIES LABELS ${labels})
    endif()
  endforeach()
endfunction()

# grove_test_over_wires(NAME): runs the same program over each transport that serializes its data. The thread sanitizer
# cannot see into gRPC.
function(grove_test_over_wires name)
  grove_add_tests(${name} ${name}_over_bytes GROVE_TEST_TRANSPORT=bytes)
  if(NOT GROVE_SANITIZE MATCHES thread)
    grove_add_tests(${name} ${name}_over_grpc GROVE_TEST_TRANSPORT=grpc)
  endif()
endfunction()

# grove_linked(TARGET OUT): all direct and indirect libraries of a target, as defined so far.
function(grove_linked target out)
  set(linked)
  set(next ${target})
  while(next)
    list(POP_FRONT next library)
    string(REGEX REPLACE "^\\$<LINK_ONLY:(.+)>$" "\\1" library "${library}")
    if(library IN_LIST linked)
      continue()
    endif()
    list(APPEND linked "${library}")
    if(TARGET "${library}")
      foreach(property IN ITEMS LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
        get_target_property(libraries "${library}" ${property})
        if(libraries)
          list(APPEND next ${libraries})
        endif()
      endforeach()
    endif()
  endwhile()
  set(${out} "${linked}" PARENT_SCOPE)
endfunction()
