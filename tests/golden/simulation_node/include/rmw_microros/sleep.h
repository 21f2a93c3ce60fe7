#error "The component 'sleep_cycles' is not selected: add `components: [+sleep_cycles]` to microros.yaml and generate again"
