/// @file command.h
/// Option readers of subcommands, for the target `arguments`. Each returns an exit status of the command.
#ifndef JN_TEST_FUZZ_COMMAND_COMMAND_H
#define JN_TEST_FUZZ_COMMAND_COMMAND_H

int fuzz_read_export(int count, char** arguments);
int fuzz_read_mesh(int count, char** arguments);
int fuzz_read_report(int count, char** arguments);
int fuzz_read_reproduce(int count, char** arguments);

#endif
