# cmake -D program=FILE -D words="completion bash" -D page=FILE -P: what the program prints becomes the file.
separate_arguments(words UNIX_COMMAND "${words}")
execute_process(COMMAND ${program} ${words} OUTPUT_FILE ${page} RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  file(REMOVE ${page})
  message(FATAL_ERROR "${program} ${words}: ${status}")
endif()
