# From the headers' comments to Doxygen's: a file's first line, what stands before a name, what stands behind it.
1s|^// kurbel\.h — |/// @mainpage kurbel from C++\n///\n/// |
1s|^// \([a-z]*\.h\) — |/// @file \1\n/// |
# What no user calls, and what parts a file.
/\/\/ for kurbel itself$/d
/^ *\/\/ --- /d
s#^\( *\)//\( \|$\)#\1///\2#
t
s|\([;,{}]\)  *// |\1  ///< |
