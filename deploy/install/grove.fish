# Completion of grove(1) for fish. It reads the help of the installed program (`grove COMMAND --help`).

function __grove_help
    set -l command
    for word in (commandline -opc)[2..]
        string match -q -- '-*' $word; and break
        set -a command $word
    end
    grove $command --help 2>/dev/null
end

function __grove_words
    set -l help (__grove_help)
    set -l previous (commandline -opc)[-1]
    if string match -q -- '-*' $previous
        set -l pattern '^  (?:-[a-z],)?'(string escape --style=regex -- $previous)' \{([^}]*)\}'
        set -l values (string match -rg -- $pattern $help)
        and string split , $values
        and return
    end
    string match -r -- '^  -\S+' $help | string split , | string match -r -- '--[a-z][a-z0-9.-]*'
    set -l commands 0
    for line in $help
        test "$line" = Subcommands:; and set commands 1
        test $commands = 1; and string match -rg -- '^  ([a-z]+) ' $line
    end
end

complete -c grove -a '(__grove_words)'
