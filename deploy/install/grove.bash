# Completion of grove(1) for bash. It reads the help of the installed program (`grove COMMAND --help`).

_grove() {
  local word current=$2 previous=$3 help option values
  local -a command=()
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word == -* ]] && break
    command+=("$word")
  done
  help=$("${COMP_WORDS[0]}" "${command[@]}" --help 2>/dev/null) || return

  if [[ $previous == -* ]]; then
    # The option's line: "  -o,--output TEXT ...", or "  --gl {auto,egl} ..." if the values are enumerated.
    option=$(grep -E -- "^  (-[a-z],)?${previous//./\\.}[ ,]" <<<"$help" | head -n 1)
    if [[ $option =~ ^\ \ [^\ ]+\ \{([^}]*)\} ]]; then
      values=${BASH_REMATCH[1]//,/ }
      mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current")
      return
    fi
    [[ $option =~ ^\ \ [^\ ]+\ [A-Z]{2} ]] && return # any value: a number, or a file by the default completion
  fi
  if [[ $current == -* ]]; then
    values=$(grep -oE -- '^  -[^ ]+' <<<"$help" | tr ',' '\n' | grep -oE -- '--[a-z][a-z0-9.-]*')
  else
    values=$(sed -n '/^Subcommands:/,$ s/^  \([a-z][a-z]*\) .*/\1/p' <<<"$help")
  fi
  mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current")
}

complete -o default -F _grove grove
