% Reads a MATLAB 5 record with Octave and prints it in the lines of tests/support/read_record.h.
% usage: octave-cli read_mat5.m FILE
1;
function print_numbers(head, values)
  printf("%s", head);
  printf("\t%.17g", values);
  printf("\n");
end
file = load(argv(){1});
print_numbers("time", file.time);
names = fieldnames(file);
for i = 1:numel(names)
  name = names{i};
  if any(strcmp(name, {"time", "record"})) continue; end
  channel = file.(name);
  if !isvarname(name) error("%s is no variable name", name); end
  printf("channel\t%s\t%s\t%s\t%.17g\t%.17g\t%s\n", channel.path, channel.unit, channel.type, channel.min, channel.max, channel.doc);
  print_numbers("data", channel.data);
  printf("variable\t%s\n", name);
end
printf("about\tname\t%s\n", jsonencode(file.record.name));
printf("about\tperiod\t\"%.17g\"\n", file.record.period);
printf("about\texperiment\t%s\n", jsonencode(file.record.experiment));
keys = fieldnames(file.record.annotations);
for i = 1:numel(keys)
  printf("about\t%s\t%s\n", keys{i}, jsonencode(file.record.annotations.(keys{i})));
end
