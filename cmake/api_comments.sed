#!/usr/bin/sed -Ef
# Marks plain comments for Doxygen (cmake/api.cmake).
/^ *\/\//s/[\\@<>#&%]/\\&/g
s/^( *)\/\/( |$)/\1\/\/\/\2/
1s/^\/\/\//\/\/\/ @file\n\/\/\//
/^ *\/\/\//!s/([;,{}]) +\/\/ (.*)$/\1  \/\/\/< \2/
