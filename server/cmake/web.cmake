# Builds the served pages from the sources in WEB in the folder BASE, and embeds them (embed.cmake). Scripts are
# bundled, so that a visit takes few requests, and all files are compressed once, here. Files that the pages refer to
# are under v/HASH: browsers cache them forever, and a changed file has another address.
file(REMOVE_RECURSE "${BASE}")
set(parts "${BASE}/parts")

# bundle(OPTION-OR-SOURCE...)
function(bundle)
  execute_process(COMMAND "${ESBUILD}" --bundle --minify --format=esm --log-level=warning "--outdir=${parts}" ${ARGN}
    WORKING_DIRECTORY "${WEB}" COMMAND_ERROR_IS_FATAL ANY)
endfunction()

bundle(--splitting main.js receiver_worker.js)
# Bundled separately: visitors do not load it.
bundle(operator.js)
file(GLOB styles RELATIVE "${WEB}" "${WEB}/*.css")
bundle(${styles})
# Not transformed: old browsers must be able to run it.
file(COPY "${WEB}/start_check.js" "${WEB}/icon.svg" DESTINATION "${parts}")

file(GLOB files "${parts}/*")
set(contents "")
foreach(file IN LISTS files)
  file(SHA256 "${file}" hash)
  string(APPEND contents "${file} ${hash}\n")
endforeach()
string(REPLACE "${BASE}" "" contents "${contents}")
string(SHA256 hash "${contents}")
string(SUBSTRING "${hash}" 0 16 hash)
file(MAKE_DIRECTORY "${BASE}/v")
file(RENAME "${parts}" "${BASE}/v/${hash}")

file(GLOB pages "${WEB}/*.html")
foreach(page IN LISTS pages)
  file(READ "${page}" text)
  string(REGEX REPLACE "(href|src)=\"([a-z_]+\\.(css|js|svg))\"" "\\1=\"/v/${hash}/\\2\"" text "${text}")
  get_filename_component(name "${page}" NAME)
  file(WRITE "${BASE}/${name}" "${text}")
endforeach()

file(GLOB_RECURSE files "${BASE}/*")
execute_process(COMMAND "${GZIP}" --best --no-name --keep ${files} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${BROTLI}" --best --keep ${files} COMMAND_ERROR_IS_FATAL ANY)

file(GLOB_RECURSE FILES "${BASE}/*")
include("${CMAKE_CURRENT_LIST_DIR}/embed.cmake")
