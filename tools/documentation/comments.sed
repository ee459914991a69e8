# Comments as Doxygen reads them: a line of its own before what it describes, or behind it.
s#^\( *\)//\( \|$\)#\1///\2#
s#\([;,{})]\)  *// #\1  ///< #
