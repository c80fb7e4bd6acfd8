# cmake -DPROGRAM=… -DOUTPUT=… -DVERSION=… -DDATA=… -DPAGES=… -P: writes the manual page pseudorigid(1) from what the program prints of
# itself, its help and its table of entries.
cmake_minimum_required(VERSION 3.25)

# ask(VARIABLE argument…): what the program prints.
function(ask variable)
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

# as_roff(VARIABLE TEXT): backslashes, hyphens that are typed as such, and lines that would be requests.
function(as_roff variable text)
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" text "${text}")
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

function(write_verbatim text)
  as_roff(text "${text}")
  file(APPEND ${OUTPUT} ".nf\n${text}\n.fi\n")
endfunction()

ask(help --help)
string(REGEX MATCH "^[^\n]*" summary "${help}")
as_roff(summary "${summary}")
file(WRITE ${OUTPUT} ".TH PSEUDORIGID 1 \"\" \"pseudorigid ${VERSION}\" \"User Commands\"
.SH NAME
pseudorigid \\- ${summary}
.SH SYNOPSIS
.B pseudorigid run
.I SCENE.prm
.RB [ options ]
.br
.B pseudorigid
.IR SUBCOMMAND \" [options]\"
.SH DESCRIPTION
")
write_verbatim("${help}")

# The subcommands are the first words of the lines below that heading.
string(REGEX REPLACE ".*\nSubcommands:\n(.*)\n\n.*" "\\1" subcommands "${help}")
string(REGEX MATCHALL "(^|\n)  [a-z]+" subcommands "${subcommands}")
foreach(subcommand ${subcommands})
  string(STRIP "${subcommand}" subcommand)
  string(TOUPPER "${subcommand}" heading)
  ask(help ${subcommand} --help)
  string(REGEX REPLACE "\n\nExit codes:.*" "" help "${help}")  # once is enough
  file(APPEND ${OUTPUT} ".SH ${heading}\n")
  write_verbatim("${help}")
endforeach()

as_roff(data "${DATA}")
as_roff(pages "${PAGES}")
file(APPEND ${OUTPUT} ".SH FILES
.TP
.I ${data}/params
Scenes to begin with; their meshes are in
.IR ${data}/meshes .
.TP
.I ${data}/tools
Programs in Python that draw and compare results.
.TP
.I ${pages}
The pages of the documentation.
")

file(APPEND ${OUTPUT} ".SH ENTRIES OF A SCENE\nOf a parameter file, each with its default.\n")
ask(entries parameters --format json)
string(JSON n_entries LENGTH "${entries}")
math(EXPR last "${n_entries} - 1")
foreach(i RANGE ${last})
  string(JSON entry GET "${entries}" ${i})
  foreach(field entry default expected unit documentation)
    string(JSON ${field}_of GET "${entry}" ${field})
    as_roff(${field}_of "${${field}_of}")
  endforeach()
  if(unit_of)
    string(APPEND expected_of " [${unit_of}]")
  endif()
  file(APPEND ${OUTPUT} ".TP\n.BR \"${entry_of}\" \" = ${default_of}\"\n${documentation_of} Expects ${expected_of}.\n")
endforeach()
