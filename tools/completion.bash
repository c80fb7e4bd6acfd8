# Completion of bash for pseudorigid. What there is to complete is asked of the program, so that it is never out of date.
# (compopt complains where the function is called by a test, not by the shell.)
# shellcheck shell=bash

_pseudorigid() {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} program=${COMP_WORDS[0]}
  local subcommand='' words=() i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    if [[ ${COMP_WORDS[i]} != -* ]]; then
      subcommand=${COMP_WORDS[i]}
      break
    fi
  done
  COMPREPLY=()
  if [[ ! $subcommand ]]; then
    mapfile -t words < <("$program" --help | sed -nE '/^Subcommands:/,/^$/ s/^  ([a-z]+).*/\1/p; s/^  (-h,)?(--[a-z]+).*/\2/p')
    mapfile -t COMPREPLY < <(compgen -W "${words[*]}" -- "$word")
  elif [[ $previous == --set ]]; then
    # An entry has a blank in its name: one line each, quoted.
    mapfile -t words < <("$program" parameters --format json | sed -nE 's/^ *"entry": "(.*)",$/\1=/p')
    local IFS=$'\n'
    mapfile -t COMPREPLY < <(compgen -W "${words[*]}" -- "${word#[\"\']}" | sed 's/ /\\ /g')
    compopt -o nospace 2>/dev/null
  elif [[ $previous == --format ]]; then
    mapfile -t words < <("$program" parameters --help | sed -nE 's/^ *--format FORMAT *//p' | sed 's/([a-z]*)//; s/ or //' | grep -oE '[a-z]+')
    mapfile -t COMPREPLY < <(compgen -W "${words[*]}" -- "$word")
  elif [[ $word == -* ]]; then
    mapfile -t words < <("$program" "$subcommand" --help | sed -nE 's/^  (-h,)?(--[a-z]+).*/\2/p')
    mapfile -t COMPREPLY < <(compgen -W "${words[*]}" -- "$word")
  elif [[ $subcommand == report || $previous == --output ]]; then
    mapfile -t COMPREPLY < <(compgen -d -- "$word")
    compopt -o filenames 2>/dev/null
  elif [[ $subcommand == run || $subcommand == check ]]; then
    mapfile -t COMPREPLY < <(compgen -f -X '!*.prm' -- "$word" && compgen -d -- "$word")
    compopt -o filenames 2>/dev/null
  fi
}
complete -F _pseudorigid pseudorigid
