# Shared by the scripts here: installs missing packages and builds. Sourced, with the repository's root as the working
# directory.

say() { printf '\033[1m== %s\033[0m\n' "$*" >&2; }

# need_packages FILE...: installs the missing ones of the Debian packages listed in the files.
need_packages() {
  local missing=() package
  for package in $(sed 's/#.*//' "$@"); do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
  done
  install_packages "${missing[@]}"
}

install_packages() {
  [ $# -gt 0 ] || return 0
  say "installing: $*"
  local as_root=()
  [ "$(id -u)" = 0 ] || as_root=(sudo)
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive sh -c "$install_without_starting" sh "$@" >&2
}

# Debian starts each service that it installs: here web servers on port 80, which only the tests need. A policy-rc.d
# that returns 101 prevents this; an existing one of the machine stays.
install_without_starting='
policy=/usr/sbin/policy-rc.d
if [ ! -e $policy ]; then
  trap "rm -f $policy" EXIT
  trap "exit 1" INT TERM
  printf "#!/bin/sh\nexit 101\n" >$policy
  chmod +x $policy
fi
apt-get install -y --no-install-recommends "$@"
'

# need_node: Node.js 18 or newer with npm, from any source.
need_node() {
  if ! command -v node >/dev/null || ! command -v npm >/dev/null; then install_packages nodejs npm; fi
}

# build PRESET [CMAKE-OPTION...]
build() {
  local preset=$1
  shift
  say "building ($preset)"
  cmake --preset "$preset" "$@" >&2
  cmake --build --preset "$preset" >&2
}

# slowest_tests LOG: the ten slowest GoogleTest cases of a log of ctest, with their seconds.
slowest_tests() {
  sed -nE 's/^\[       OK \] (\S+) \(([0-9]+) ms\)$/\2 \1/p' "$1" | sort -rn |
    awk 'NR <= 10 { printf "%7.1f s  %s\n", $1 / 1000, $2 }'
}

# changed_sources COUNT: the last changed sources, newest first: uncommitted ones, then by the history. For a header,
# the source of its name. Needs no base, so it works in any clone. Skips sources that only the fuzz preset builds.
changed_sources() {
  local files=('server/*.cpp' 'server/*.h' 'tests/*.cpp' 'tests/*.h' ':!tests/fuzz') file
  { git diff --name-only HEAD -- "${files[@]}"; git log --format= --name-only -- "${files[@]}"; } |
    sed 's/\.h$/.cpp/' | awk '!seen[$0]++' |
    while read -r file; do if [ -f "$file" ]; then echo "$file"; fi; done | sed "$1q"
}
