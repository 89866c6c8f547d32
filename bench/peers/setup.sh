#!/bin/sh
# Makes a virtual environment for each peer: setup.sh [FOLDER] [PEER...]
# FOLDER is .venvs beside this script unless given; PYTHON names the interpreter (3.11).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=${1:-$here/.venvs}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- blender mitsuba pyviewfactor embree
python=${PYTHON:-python3.11}

mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
for peer in "$@"; do
    "$python" -m venv "$folder/$peer"
    "$folder/$peer/bin/pip" install --quiet --disable-pip-version-check \
        -r "$here/requirements-$peer.txt" || echo "skipped: $peer does not install here"
done

# Mitsuba's llvm variants load libLLVM when they run; older ones than 19 may end the process.
case " $* " in *" mitsuba "*)
    mkdir -p "$folder/llvm"
    cd "$folder/llvm"
    if apt-get download -qq libllvm19 2>/dev/null && dpkg -x libllvm19_*.deb .; then
        rm -f libllvm19_*.deb
    else
        echo "skipped: no Debian package libllvm19; Mitsuba runs without its llvm variants"
    fi
esac
