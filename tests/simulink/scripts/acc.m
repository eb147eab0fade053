function y = acc(f)
persistent s
if isempty(s)
    s = 0;
end
for i = 1:2
    s = s + f(i);
end
s = s - f(3);
y = s;
