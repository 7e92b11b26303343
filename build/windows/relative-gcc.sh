#!/bin/sh
# Named as a gcc, by which the compiler knows how to call it.
# GNU ld orders import tables by the paths of their files. Seen from the target directory, AHV_TARGET,
# these paths sort the same on every machine, so the library has the same bytes wherever it is built.
set -eu
cd "$AHV_TARGET"
for argument in "$@"; do
    shift
    case $argument in
    "$AHV_TARGET"/*) argument=./${argument#"$AHV_TARGET"/} ;;
    esac
    set -- "$@" "$argument"
done
exec x86_64-w64-mingw32-gcc "$@"
