# cmake -DNAME=... -DINPUT=file -DOUTPUT=file.cpp -P embed.cmake: the text of a file as pigment::report::page_NAME.
file(READ "${INPUT}" text)
if(text MATCHES "\\)embedded\"")
  message(FATAL_ERROR "${INPUT} holds the mark that ends the embedded text")
endif()
file(WRITE "${OUTPUT}" "#include \"report/page_assets.h\"\nnamespace pigment::report {\n"
  "const std::string_view page_${NAME} = R\"embedded(${text})embedded\";\n}\n")
